#include "analysis/adaptation/state_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/conclusions/comparison.h"
#include "base/error.h"
#include "base/math/matrix.h"
#include "base/math/seeded.h"

#include <unsupported/Eigen/NonLinearOptimization>

namespace reachlab::analysis {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Unbounded parameters t: the sine's square keeps each number between 0 and 1, and the products keep the order of the states.
///     one state:  A = s(t0),  B = s(t1)
///     two states: A_s = s(t0), A_f = A_s s(t1), B_f = s(t2), B_s = B_f s(t3)
double s(double t) { return std::sin(t) * std::sin(t); }
double sRate(double t) { return std::sin(2 * t); }
double tOf(double share) { return std::asin(std::sqrt(std::clamp(share, 0.0, 1.0))); }

std::vector<LearningState> statesOf(const VectorXd& t) {
  if (t.size() == 2) return {{s(t[0]), s(t[1])}};
  return {{s(t[0]) * s(t[1]), s(t[2])}, {s(t[0]), s(t[2]) * s(t[3])}};
}

VectorXd parametersOf(const std::vector<LearningState>& states) {
  if (states.size() == 1) return Eigen::Vector2d(tOf(states[0].retention), tOf(states[0].learningRate));
  const LearningState &fast = states[0], &slow = states[1];
  const auto ratio = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  return Eigen::Vector4d(tOf(slow.retention), tOf(ratio(fast.retention, slow.retention)), tOf(fast.learningRate),
                         tOf(ratio(slow.learningRate, fast.learningRate)));
}

/// d(A_1, B_1, A_2, B_2 …)/dt.
MatrixXd stateRates(const VectorXd& t) {
  MatrixXd rates = MatrixXd::Zero(t.size(), t.size());
  if (t.size() == 2) {
    rates(0, 0) = sRate(t[0]);
    rates(1, 1) = sRate(t[1]);
    return rates;
  }
  rates(0, 0) = sRate(t[0]) * s(t[1]);
  rates(0, 1) = s(t[0]) * sRate(t[1]);
  rates(1, 2) = sRate(t[2]);
  rates(2, 0) = sRate(t[0]);
  rates(3, 2) = sRate(t[2]) * s(t[3]);
  rates(3, 3) = s(t[2]) * sRate(t[3]);
  return rates;
}

/// The residuals x - response of the measured trials, and their derivatives by t, as Eigen's Levenberg-Marquardt asks for them.
struct Residuals {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const AdaptationSeries& series;
  int parameters, measured;
  int inputs() const { return parameters; }
  int values() const { return measured; }

  int operator()(const VectorXd& t, VectorXd& residual) const {
    const std::vector<double> x = simulateLearning(statesOf(t), series);
    for (std::size_t n = 0, row = 0; n < series.size(); ++n)
      if (series[n].response) residual[static_cast<Eigen::Index>(row++)] = x[n] - *series[n].response;
    return 0;
  }

  int df(const VectorXd& t, MatrixXd& jacobian) const {
    const std::vector<LearningState> states = statesOf(t);
    const MatrixXd chain = stateRates(t);
    const auto count = static_cast<Eigen::Index>(states.size());
    VectorXd x = VectorXd::Zero(count);
    MatrixXd dx = MatrixXd::Zero(count, 2 * count);  // of each state by A_1, B_1, A_2, B_2 …
    Eigen::Index row = 0;
    for (const AdaptationTrial& trial : series) {
      if (trial.response) jacobian.row(row++) = dx.colwise().sum() * chain;
      const double error = trial.perturbation ? *trial.perturbation - x.sum() : 0;
      const Eigen::RowVectorXd dError = trial.perturbation ? Eigen::RowVectorXd(-dx.colwise().sum()) : Eigen::RowVectorXd::Zero(2 * count);
      for (Eigen::Index k = 0; k < count; ++k) {
        const LearningState& state = states[static_cast<std::size_t>(k)];
        dx.row(k) = state.retention * dx.row(k) + state.learningRate * dError;
        dx(k, 2 * k) += x[k];
        dx(k, 2 * k + 1) += error;
        x[k] = state.retention * x[k] + state.learningRate * error;
      }
    }
    return 0;
  }
};

struct Least {
  VectorXd t;
  double sum = std::numeric_limits<double>::infinity();  // of the residuals' squares
};

Least descend(const Residuals& residuals, VectorXd t) {
  constexpr double kTolerance = 1e-12;  // relative, of the sum and of the parameters: well below what a series can tell
  Residuals functor = residuals;
  Eigen::LevenbergMarquardt<Residuals> method(functor);
  method.parameters.ftol = method.parameters.xtol = kTolerance;
  method.parameters.maxfev = 1000;
  method.minimize(t);
  VectorXd residual(residuals.measured);
  residuals(t, residual);
  return {t, residual.squaredNorm()};
}

// Starts spread over what has been published: retention 0.4 to 0.99 and learning rates 0.01 to 0.4.
std::vector<std::vector<LearningState>> startsOf(std::size_t states) {
  std::vector<std::vector<LearningState>> starts;
  if (states == 1) {
    for (const double a : {0.5, 0.9, 0.99})
      for (const double b : {0.02, 0.1, 0.4}) starts.push_back({{a, b}});
    return starts;
  }
  for (const double fast : {0.4, 0.8})
    for (const double slow : {0.95, 0.995})
      for (const double quick : {0.1, 0.4})
        for (const double gradual : {0.01, 0.05}) starts.push_back({{fast, quick}, {slow, gradual}});
  return starts;
}

LearningFit fitStates(std::size_t states, const AdaptationSeries& series, int measured) {
  const Residuals residuals{series, static_cast<int>(2 * states), measured};
  Least best;
  for (const auto& start : startsOf(states))
    if (const Least found = descend(residuals, parametersOf(start)); found.sum < best.sum) best = found;
  LearningFit fit{statesOf(best.t), best.sum / measured, 0, {}};
  double scale = 0;
  for (const AdaptationTrial& trial : series)
    if (trial.response) scale = std::max(scale, std::abs(*trial.response));
  // Residuals below the rounding of the responses are equal to none.
  const double least = std::pow(std::numeric_limits<double>::epsilon() * scale, 2);
  fit.bic = measured * std::log(std::max({fit.meanSquare, least, std::numeric_limits<double>::min()})) +
            2.0 * static_cast<double>(states) * std::log(measured);
  return fit;
}

/// Quantile of sorted values, linear between them (Hyndman and Fan's type 7).
double quantileOfSorted(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  if (i + 1 >= sorted.size()) return sorted.back();
  return sorted[i] + (at - static_cast<double>(i)) * (sorted[i + 1] - sorted[i]);
}

/// The share below a 95 % percentile interval from so few independent blocks: beyond 2.5 % as far as Student's t is beyond the normal
/// distribution (Hesterberg 2015, The American Statistician 69:371, "expanded percentile interval").
double shareBelow(double freedom) {
  const double t = computeTQuantile(0.95, std::max(1.0, freedom));
  return 0.5 * std::erfc(t / std::numbers::sqrt2);
}

/// Percentile intervals from series whose residuals are drawn with replacement in blocks of neighbours. A fit takes part of the noise, so
/// its residuals are enlarged before they are drawn.
void addIntervals(LearningFit& fit, const AdaptationSeries& series, int measured, int resamples, std::uint64_t seed) {
  const std::vector<double> x = simulateLearning(fit.states, series);
  std::vector<std::size_t> at;
  std::vector<double> residual;
  for (std::size_t n = 0; n < series.size(); ++n)
    if (series[n].response) at.push_back(n), residual.push_back(*series[n].response - x[n]);
  // A block as long as the cube root of the series: Hall, Horowitz & Jing (1995) for the spread of an estimate.
  const std::size_t count = residual.size(), block = std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(std::cbrt(count))));
  const std::size_t places = count - block + 1;
  const double parameters = 2.0 * static_cast<double>(fit.states.size()), responses = static_cast<double>(count);
  for (double& value : residual) value *= std::sqrt(responses / (responses - parameters));
  std::vector<std::vector<double>> found(2 * fit.states.size());
  AdaptationSeries drawn = series;
  for (int sample = 0; sample < resamples; ++sample) {
    for (std::size_t i = 0, from = 0; i < count; ++i) {
      if (i % block == 0)
        from = static_cast<std::size_t>(seededFraction(seed, static_cast<std::uint64_t>(sample) * count + i) * static_cast<double>(places));
      drawn[at[i]].response = x[at[i]] + residual[from + i % block];
    }
    const Residuals residuals{drawn, static_cast<int>(2 * fit.states.size()), measured};
    // Beside the estimate itself a start inside the bounds, where the sine's square has a slope.
    Least least = descend(residuals, parametersOf(fit.states));
    if (const Least inside = descend(residuals, parametersOf(startsOf(fit.states.size()).front())); inside.sum < least.sum) least = inside;
    const std::vector<LearningState> states = statesOf(least.t);
    for (std::size_t k = 0; k < states.size(); ++k) {
      found[2 * k].push_back(states[k].retention);
      found[2 * k + 1].push_back(states[k].learningRate);
    }
  }
  for (auto& values : found) std::sort(values.begin(), values.end());
  const double below = shareBelow(responses / static_cast<double>(block) - parameters);
  const auto interval = [&](const std::vector<double>& sorted) {
    return Bounds{quantileOfSorted(sorted, below), quantileOfSorted(sorted, 1 - below)};
  };
  for (std::size_t k = 0; k < fit.states.size(); ++k) fit.intervals.push_back({interval(found[2 * k]), interval(found[2 * k + 1])});
}

}  // namespace

std::vector<double> simulateLearning(const std::vector<LearningState>& states, const AdaptationSeries& series) {
  std::vector<double> x, now(states.size());
  for (const AdaptationTrial& trial : series) {
    const double sum = sumOf(now);
    x.push_back(sum);
    const double error = trial.perturbation ? *trial.perturbation - sum : 0;
    for (std::size_t k = 0; k < states.size(); ++k) now[k] = states[k].retention * now[k] + states[k].learningRate * error;
  }
  return x;
}

AdaptationFit fitAdaptation(const AdaptationSeries& series, int resamples, std::uint64_t seed) {
  constexpr std::size_t kLeastResponses = 12;  // three for each parameter of two states
  constexpr std::size_t kMostTrials = 10'000;  // the fit and its intervals take minutes
  constexpr double kLargest = 1e100;           // of a number and of its inverse, whose squares a double holds with room for sums
  constexpr double kStrong = 6;                // difference of criteria; Kass & Raftery (1995)
  AdaptationFit fit;
  bool perturbed = false, answered = false;  // some trial is perturbed; a response is measured after one
  double largest = 0;
  for (const AdaptationTrial& trial : series) {
    largest = std::max({largest, std::abs(trial.perturbation.value_or(0)), std::abs(trial.response.value_or(0))});
    fit.responses += trial.response.has_value();
    fit.channels += !trial.perturbation;
    answered = answered || (perturbed && trial.response);
    perturbed = perturbed || (trial.perturbation && *trial.perturbation != 0);
  }
  if (!perturbed) throw RefusedError("every perturbation is 0 or a channel, so there is nothing to learn");
  if (!answered) throw RefusedError("no response is measured after a perturbation, so nothing shows what was learnt");
  if (fit.responses < kLeastResponses)
    throw RefusedError("only " + std::to_string(fit.responses) + " responses are measured; a fit needs " + std::to_string(kLeastResponses) +
                       " or more");
  if (series.size() > kMostTrials)
    throw RefusedError(fmt::format("the series has {} trials; a fit takes up to {}", series.size(), kMostTrials));
  if (!(largest <= kLargest && largest >= 1 / kLargest))
    throw RefusedError(fmt::format("the largest number of the series is {:g}; a fit needs a unit in which it is 1e-100 to 1e100", largest));
  const int measured = static_cast<int>(fit.responses);
  fit.one = fitStates(1, series, measured);
  fit.two = fitStates(2, series, measured);
  addIntervals(fit.one, series, measured, resamples, seed);
  addIntervals(fit.two, series, measured, resamples, seed);
  const double gain = fit.one.bic - fit.two.bic;
  fit.count = gain > kStrong ? StateCount::Two : gain < -kStrong ? StateCount::One : StateCount::Undecided;
  return fit;
}

}  // namespace reachlab::analysis
