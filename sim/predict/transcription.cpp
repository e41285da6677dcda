#include "sim/predict/transcription.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"

namespace reachlab::predict {
namespace {

constexpr int kMostIterations = 60;
constexpr double kSettled = 1e-7;  // change of the unknowns, relative, after which Newton's error, its square, is below rounding
// Error of the profile, of its peak, that is aimed at: for the motion itself, and for a flat output, of which the hand is a sum
// of higher derivatives.
constexpr double kProfile = 2e-9, kFlatProfile = 1e-11;
constexpr double kUseless = 1e-2;  // of the peak

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

}  // namespace

LegendreSeries TranscribedMotion::derivative(int motion, int m) const {
  LegendreSeries series = basis.combine(coefficient[motion], m);
  for (double& c : series) c *= std::pow(2 / duration, m);
  if (m == 0) series[0] += start[motion];
  return series;
}

TranscribedMotion solveTranscription(const TranscribedProblem& problem, int unknowns, const std::vector<std::vector<double>>& guess) {
  const int motions = static_cast<int>(problem.from.size()), total = motions * unknowns;
  TranscribedMotion motion{RestToRestBasis(problem.order, unknowns), {}, problem.from, problem.duration};
  const TranscribedCost cost(problem, motion.basis);
  Vector c = Vector::Zero(total), gradient;
  Matrix hessian;
  for (size_t m = 0; m < guess.size(); ++m)
    for (size_t k = 0; k < guess[m].size() && k < static_cast<size_t>(unknowns); ++k)
      c(static_cast<int>(m) * unknowns + static_cast<int>(k)) = guess[m][k];

  double damping = 0;
  bool settled = false;
  for (int iteration = 0; iteration < kMostIterations && !settled; ++iteration) {
    motion.cost = cost.expand(c, gradient, hessian);
    motion.iterations = iteration + 1;
    if (!std::isfinite(motion.cost)) break;
    const double scale = hessian.diagonal().cwiseAbs().maxCoeff();
    Eigen::LLT<Matrix> factor(hessian + damping * scale * Matrix::Identity(total, total));
    while (factor.info() != Eigen::Success) {  // not convex here: lean towards steepest descent
      damping = std::max(10 * damping, 1e-6);
      factor.compute(hessian + damping * scale * Matrix::Identity(total, total));
    }
    const Vector step = -factor.solve(gradient);
    double length = 1;
    const double slope = gradient.dot(step), small = kSettled * (c.norm() + 1e-3 * std::abs(problem.to[0] - problem.from[0]));
    settled = damping == 0 && step.norm() <= small;
    while (!settled && length > 1e-6 && !(cost.evaluate(c + length * step) <= motion.cost + 1e-4 * length * slope + 1e-14 * motion.cost))
      length /= 2;
    c += length * step;
    damping = length < 0.1 ? std::max(10 * damping, 1e-6) : damping < 1e-5 ? 0 : damping / 10;
    if (settled) {
      motion.cost = cost.evaluate(c);
      const Vector unit = hessian.diagonal().cwiseSqrt().cwiseInverse();  // each unknown in its own measure
      const double rcond = Eigen::LLT<Matrix>(unit.asDiagonal() * hessian * unit.asDiagonal()).rcond();
      motion.condition = rcond > 0 ? 1 / std::sqrt(rcond) : std::numeric_limits<double>::infinity();
    }
  }
  if (!settled)
    throw RefusedError(fmt::format("no minimum was found within {} Newton steps; another posture, a longer time or another path may help",
                                   kMostIterations));
  for (int m = 0; m < motions; ++m) {
    std::vector<double> all{problem.to[m] - problem.from[m]};
    all.insert(all.end(), c.data() + m * unknowns, c.data() + (m + 1) * unknowns);
    motion.coefficient.push_back(std::move(all));
  }
  return motion;
}

double estimateError(double change, double before) { return change < before ? change * std::pow(change / before, 1.5) : change; }

TranscribedMotion solveTranscriptionAdaptively(const TranscribedProblem& problem, int unknowns,
                                               const std::vector<std::vector<double>>& guess) {
  if (unknowns > 0) return solveTranscription(problem, unknowns, guess);
  constexpr int kFirst = 16, kMost = 450;
  TranscribedMotion motion = solveTranscription(problem, kFirst, guess);
  double before = 0;
  for (int n = kFirst + kFirst / 2; n <= kMost; n += n / 2) {
    std::vector<std::vector<double>> warm;
    for (const auto& c : motion.coefficient) warm.emplace_back(c.begin() + 1, c.end());
    TranscribedMotion finer = solveTranscription(problem, n, warm);
    double change = 0, peak = 0;
    for (size_t m = 0; m < problem.from.size(); ++m) {
      const LegendreSeries coarse = motion.derivative(static_cast<int>(m), 1), fine = finer.derivative(static_cast<int>(m), 1);
      for (int i = 0; i <= 64; ++i) {
        const double x = i / 32.0 - 1, v = evaluate(fine, x);
        peak = std::max(peak, std::abs(v));
        change = std::max(change, std::abs(v - evaluate(coarse, x)));
      }
    }
    motion = std::move(finer);
    motion.uncertainty = estimateError(change / peak, before);
    before = change / peak;
    if (motion.uncertainty < (problem.order > 3 ? kFlatProfile : kProfile)) {
      motion.uncertainty = 0;
      return motion;
    }
  }
  if (!(motion.uncertainty < kUseless))
    throw RefusedError(fmt::format("the profile still changes by {:.1e} of its peak with {} unknowns; another path or start may help",
                                   motion.uncertainty, kMost));
  return motion;
}

TranscribedMotion solveFromStarts(const TranscribedProblem& problem, int unknowns) {
  constexpr int kTrial = 16;
  constexpr double kBend = 0.2;  // of the way, early or late, for the starts that are not straight
  const RestToRestBasis basis(problem.order, 2);
  std::optional<TranscribedMotion> best;
  std::string refusal;
  const size_t motions = problem.from.size();
  for (int start = 0; start < 1 + 2 * static_cast<int>(motions); ++start) {
    std::vector<std::vector<double>> guess(motions);
    if (start > 0) {
      const size_t motion = static_cast<size_t>(start - 1) / 2;
      const double way = std::max(std::abs(problem.to[motion] - problem.from[motion]), 1e-3);
      guess[motion] = {(start % 2 ? kBend : -kBend) * way / std::abs(evaluate(basis.derivative(1, 0), 0.4))};
    }
    try {
      TranscribedMotion found = solveTranscription(problem, unknowns > 0 ? unknowns : kTrial, guess);
      if (!best || found.cost < best->cost * (1 - 1e-9)) best = std::move(found);
    } catch (const RefusedError& refused) {
      refusal = refused.what();
    }
  }
  if (!best) throw RefusedError(refusal);
  if (unknowns > 0) return std::move(*best);
  std::vector<std::vector<double>> warm;
  for (const auto& c : best->coefficient) warm.emplace_back(c.begin() + 1, c.end());
  return solveTranscriptionAdaptively(problem, 0, warm);
}

SeriesOfOne makeSeriesOfVelocity(const LegendreSeries& velocity, double duration) {
  SeriesOfOne one;
  one.velocity = velocity;
  one.position = integrate(velocity);
  for (double& c : one.position) c *= duration / 2;
  // P_n' = (2n-1) P_(n-1) + P_(n-2)', from the top.
  one.acceleration.assign(velocity.size(), 0);
  for (size_t n = velocity.size(); n-- > 1;) {
    const double above = n + 1 < velocity.size() ? one.acceleration[n + 1] / (2 * static_cast<double>(n) + 3) : 0;
    one.acceleration[n - 1] = (2 * static_cast<double>(n) - 1) * (velocity[n] + above);
  }
  for (double& c : one.acceleration) c *= 2 / duration;
  return one;
}

namespace {

class LegendrePrediction final : public Prediction {
 public:
  LegendrePrediction(SeriesOfOne hand, std::vector<SeriesOfOne> masses, double seconds)
      : hand_(std::move(hand)), masses_(std::move(masses)) {
    duration = seconds;
    massCount_ = static_cast<int>(masses_.size());
    fastest_ = static_cast<double>(hand_.position.size()) / seconds;
  }
  PredictedHand handAt(double t) const override {
    const double x = 2 * t / duration - 1;
    return {evaluate(hand_.position, x), evaluate(hand_.velocity, x), evaluate(hand_.acceleration, x)};
  }
  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    const double x = 2 * t / duration - 1;
    for (size_t i = 0; i < masses_.size(); ++i)
      position[i] = evaluate(masses_[i].position, x), velocity[i] = evaluate(masses_[i].velocity, x);
  }

 private:
  SeriesOfOne hand_;
  std::vector<SeriesOfOne> masses_;
};

}  // namespace

void describeMotion(const TranscribedMotion& motion, Prediction& prediction) {
  prediction.cost = motion.cost;
  prediction.condition = motion.condition;
  if (motion.uncertainty > 0)
    prediction.warnings.push_back(fmt::format("the profile is known to {:.0e} of its peak only: the path bends too sharply for {} unknowns",
                                              motion.uncertainty, motion.basis.columns() - 1));
}

std::unique_ptr<Prediction> makeLegendrePrediction(SeriesOfOne hand, std::vector<SeriesOfOne> masses, double duration) {
  auto prediction = std::make_unique<LegendrePrediction>(std::move(hand), std::move(masses), duration);
  prediction->handJump = 0.0;
  prediction->handVelocityJump = 0.0;
  return prediction;
}

}  // namespace reachlab::predict
