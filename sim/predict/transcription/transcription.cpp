#include "sim/predict/transcription/transcription.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/math/matrix.h"

namespace reachlab::predict {
namespace {

constexpr int kMaxIterations = 60;
constexpr double kSettled = 1e-7;  // change of the unknowns, relative, after which Newton's error, its square, is below rounding
// Error of the profile, of its peak, that is aimed at: for the motion itself, and for a flat output, of which the hand is a sum
// of higher derivatives.
constexpr double kProfile = 2e-9, kFlatProfile = 1e-11;
constexpr double kRounding = 1e-12;  // of the peak
constexpr double kUseless = 1e-2;    // of the peak
constexpr double kSeen = 1e-6;       // of the cost, by many more nodes than those that it was found with

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

}  // namespace

LegendreSeries TranscribedMotion::derivative(int motion, int m) const {
  LegendreSeries series = basis.combine(coefficient[motion], m);
  for (double& c : series) c *= std::pow(2 / duration, m);
  if (m == 0) series[0] += start[motion];
  return series;
}

std::array<double, 4> TranscribedMotion::at(int motion, double t) const {
  std::vector<double> table(static_cast<size_t>(basis.columns() * (basis.order() + 1)));
  basis.tabulate(2 * t / duration - 1, 2 / duration, table.data());
  std::array<double, 4> y{start[motion]};
  const std::vector<double>& c = coefficient[motion];
  for (size_t column = 0; column < c.size(); ++column)
    for (size_t m = 0; m < 4; ++m) y[m] += c[column] * table[column * (static_cast<size_t>(basis.order()) + 1) + m];
  return y;
}

TranscribedMotion solveTranscription(const TranscribedProblem& problem, int unknowns, const std::vector<std::vector<double>>& guess) {
  WorkLimit::hold(0.5 * (problem.order + 1) * unknowns * unknowns);  // of the basis
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
  for (int iteration = 0; iteration < kMaxIterations && !settled; ++iteration) {
    motion.cost = cost.expand(c, gradient, hessian);
    if (!std::isfinite(motion.cost)) break;
    problem.work->spend(std::pow(total, 3) / 6);
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
                                   kMaxIterations));
  for (int m = 0; m < motions; ++m) {
    std::vector<double> all{problem.to[m] - problem.from[m]};
    all.insert(all.end(), c.data() + m * unknowns, c.data() + (m + 1) * unknowns);
    motion.coefficient.push_back(std::move(all));
  }
  return motion;
}

double estimateError(double change, double before) { return change < before ? change * std::pow(change / before, 1.5) : change; }
double boundError(double change, double before) { return std::max(kRounding, change < before ? change * change / before : change); }

namespace {

using Guess = std::vector<std::vector<double>>;

Guess guessFrom(const TranscribedMotion& motion) {
  Guess guess;
  for (const auto& c : motion.coefficient) guess.emplace_back(c.begin() + 1, c.end());
  return guess;
}

// Change of the motions' velocities, of the largest of them.
double compare(const TranscribedMotion& coarse, const TranscribedMotion& fine) {
  double change = 0, peak = 0;
  for (size_t m = 0; m < fine.start.size(); ++m) {
    const LegendreSeries before = coarse.derivative(static_cast<int>(m), 1), after = fine.derivative(static_cast<int>(m), 1);
    for (int i = 0; i <= 64; ++i) {
      const double x = i / 32.0 - 1, v = valueAt(after, x);
      peak = std::max(peak, std::abs(v));
      change = std::max(change, std::abs(v - valueAt(before, x)));
    }
  }
  return change / peak;
}

TranscribedMotion raiseUnknowns(const TranscribedProblem& problem, TranscribedMotion motion, const HandInSpace& placeOf) {
  constexpr int kMaxUnknowns = 450, kMaxUnseen = 4;
  int unseen = 0;
  const double wanted = problem.order > 3 ? kFlatProfile : kProfile;
  double before = 0;
  PathCheck check;
  // Whether many more places say the same as those that it was computed at.
  const auto isSeen = [&](const TranscribedMotion& found, double error) {
    check = checkPath(problem.duration, [&](double t) { return placeOf(found, t); });
    return check.smooth && std::abs(check.cost - found.cost) <= std::max(kSeen, 10 * error) * found.cost;
  };
  const auto raise = [&](int unknowns) -> std::string {  // why it cannot be
    try {
      TranscribedMotion finer = solveTranscription(problem, unknowns, guessFrom(motion));
      const double change = compare(motion, finer);
      motion = std::move(finer);
      motion.uncertainty = estimateError(change, before);
      motion.errorBound = boundError(change, std::exchange(before, change));
      return {};
    } catch (const RefusedError& refused) {
      return refused.what();
    }
  };
  std::string refusal;  // of the last
  for (int n = motion.basis.columns() - 1; (n += n / 2) <= kMaxUnknowns;) {
    if (refusal = raise(n); !refusal.empty()) continue;
    if (motion.uncertainty >= wanted) continue;
    if (!placeOf || isSeen(motion, wanted)) return motion;
    if (++unseen == kMaxUnseen) break;  // what does not show in so many raises is no bump that more unknowns would follow
  }
  if (!refusal.empty()) throw RefusedError(refusal);
  if (!(motion.uncertainty < kUseless))
    throw RefusedError(fmt::format("the profile still changes by {:.1e} of its peak with {} unknowns; another path or start may help",
                                   motion.uncertainty, kMaxUnknowns));
  if (placeOf && !isSeen(motion, motion.uncertainty))
    throw RefusedError(
        fmt::format("the way has a kink, a jump, a step of its curvature or a bump too narrow to be resolved, met {}: no "
                    "movement of finite jerk passes it but at rest; allowed: a start and a target with none between them",
                    check.smooth ? "on the way" : fmt::format("after {:.3g} s", check.brokenAt)));
  return motion;
}

// With the error of its profile: what half as many unknowns again change.
TranscribedMotion estimated(const TranscribedProblem& problem, TranscribedMotion motion) {
  const int unknowns = motion.basis.columns() - 1;
  const TranscribedMotion finer = solveTranscription(problem, unknowns + std::max(2, unknowns / 2), guessFrom(motion));
  motion.uncertainty = motion.errorBound = std::max(kRounding, compare(motion, finer));
  return motion;
}

// The lowest minimum of the straight start and others that are bent from it.
TranscribedMotion solveFromBentStarts(const TranscribedProblem& problem, int unknowns) {
  constexpr double kBend = 0.2;  // of the way, early or late, for the starts that are not straight
  const RestToRestBasis basis(problem.order, 2);
  std::optional<TranscribedMotion> best;
  std::string refusal;
  const size_t motions = problem.from.size();
  for (int start = 0; start < 1 + 2 * static_cast<int>(motions); ++start) {
    Guess guess(motions);
    if (start > 0) {
      const size_t motion = static_cast<size_t>(start - 1) / 2;
      const double way =
          problem.detour.empty() ? std::max(std::abs(problem.to[motion] - problem.from[motion]), 1e-3) : problem.detour[motion];
      guess[motion] = {(start % 2 ? kBend : -kBend) * way / std::abs(valueAt(basis.derivative(1, 0), 0.4))};
    }
    try {
      TranscribedMotion found = solveTranscription(problem, unknowns, guess);
      if (!best || found.cost < best->cost * (1 - 1e-9)) best = std::move(found);
    } catch (const RefusedError& refused) {
      refusal = refused.what();
    }
  }
  if (!best) throw RefusedError(refusal);
  return std::move(*best);
}

}  // namespace

TranscribedMotion solveFromStarts(const TranscribedProblem& problem, int unknowns, const HandInSpace& placeOf) {
  if (unknowns > 0) return estimated(problem, solveFromBentStarts(problem, unknowns));
  constexpr int kFirst = 16, kMaxAtFirst = 200;  // a way that bends often is not followed by few unknowns
  std::optional<TranscribedMotion> found;
  for (int n = kFirst; !found; n *= 3) {
    try {
      found = solveFromBentStarts(problem, n);
    } catch (const RefusedError&) {
      if (3 * n > kMaxAtFirst) throw;
    }
  }
  return raiseUnknowns(problem, *std::move(found), placeOf);
}

std::optional<TranscribedMotion> solveFromNeighbours(const TranscribedProblem& problem, std::span<const Prediction* const> near) {
  constexpr size_t kMost = 6;
  std::vector<const Prediction*> used;
  for (const Prediction* p : near)
    if (!p->unknowns.empty()) used.push_back(p);
  const auto apart = [&](const Prediction* p) { return std::abs(p->duration - problem.duration); };
  std::stable_sort(used.begin(), used.end(), [&](const Prediction* a, const Prediction* b) { return apart(a) < apart(b); });
  // A polynomial that is continued beyond its points goes astray the sooner the more of them there are.
  if (used.size() > kMost) used.resize(kMost);
  std::erase_if(used, [&](const Prediction* p) { return p->unknowns.size() != used.front()->unknowns.size(); });
  if (used.empty()) return std::nullopt;
  std::vector<double> guess(used.front()->unknowns.size(), 0.0);
  for (const Prediction* p : used) {
    double weight = 1;
    for (const Prediction* other : used)
      if (other != p) weight *= (problem.duration - other->duration) / (p->duration - other->duration);
    for (size_t k = 0; k < guess.size(); ++k) guess[k] += weight * p->unknowns[k];
  }
  try {
    return solveTranscription(problem, static_cast<int>(guess.size()), {guess});
  } catch (const RefusedError&) {
    return std::nullopt;
  }
}

MotionSeries makeSeriesOfSpeed(const std::function<double(double)>& speed, int columns, double duration) {
  const GaussRule rule = makeGaussRule(3 * columns + 40);
  std::vector<double> values;
  for (const double x : rule.node) values.push_back(speed(duration * (x + 1) / 2));
  return makeSeriesOfVelocity(projectOnLegendre(values, rule.node, rule.weight), duration);
}

MotionSeries makeSeriesOfVelocity(const LegendreSeries& velocity, double duration) {
  MotionSeries one;
  one.velocity = velocity;
  one.position = integralOf(velocity);
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
  LegendrePrediction(MotionSeries hand, std::vector<MotionSeries> masses, double seconds)
      : hand_(std::move(hand)), masses_(std::move(masses)) {
    duration = seconds;
    massCount_ = static_cast<int>(masses_.size());
    fastest_ = static_cast<double>(hand_.position.size()) / seconds;
  }
  PredictedHand handAt(double t) const override {
    const double x = 2 * t / duration - 1;
    return {valueAt(hand_.position, x), valueAt(hand_.velocity, x), valueAt(hand_.acceleration, x)};
  }
  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    const double x = 2 * t / duration - 1;
    for (size_t i = 0; i < masses_.size(); ++i)
      position[i] = valueAt(masses_[i].position, x), velocity[i] = valueAt(masses_[i].velocity, x);
  }
  double objectVelocityAt(double t) const override { return valueAt(objectSeries().velocity, 2 * t / duration - 1); }
  void sampleVelocities(std::span<double> hand, std::span<double> object) const override {
    const auto last = static_cast<double>(hand.size() - 1);
    for (size_t i = 0; i < hand.size(); ++i) {
      const double x = 2 * (static_cast<double>(i) / last) - 1;
      hand[i] = valueAt(hand_.velocity, x);
      object[i] = valueAt(objectSeries().velocity, x);
    }
  }

 private:
  const MotionSeries& objectSeries() const { return masses_.empty() ? hand_ : masses_.back(); }  // without an object the hand itself moves

  MotionSeries hand_;
  std::vector<MotionSeries> masses_;
};

}  // namespace

void describeMotion(const TranscribedMotion& motion, Prediction& prediction) {
  prediction.cost = motion.cost;
  prediction.condition = motion.condition;
  if (motion.errorBound > 0) prediction.profileError = motion.errorBound;
  if (motion.uncertainty >= kProfile)
    prediction.warnings.push_back(fmt::format("the profile is known to {:.0e} of its peak only: the path bends too sharply for {} unknowns",
                                              motion.errorBound, motion.basis.columns() - 1));
}

std::unique_ptr<Prediction> makeLegendrePrediction(MotionSeries hand, std::vector<MotionSeries> masses, double duration) {
  return std::make_unique<LegendrePrediction>(std::move(hand), std::move(masses), duration);
}

}  // namespace reachlab::predict
