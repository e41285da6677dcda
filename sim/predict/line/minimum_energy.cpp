#include "sim/predict/line/minimum_energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <optional>
#include <type_traits>

#include "base/error.h"
#include "sim/predict/line/energy_movement.h"
#include "sim/predict/line/gramian.h"
#include "sim/predict/prediction/condition.h"

namespace reachlab::predict {
namespace {

constexpr double kShort = 0.5;     // fastest rate times the time that the doubling starts from
constexpr int kHalfDoublings = 3;  // from there to half an interval of the profile: rate times half an interval is 4 at most
constexpr int kMaxPasses = 4;
constexpr size_t kFirstMemory = 48 * 1024;  // [B] of a chain of five in double

// The weights under which the movement comes to the target. W carries the square of the condition into its inverse; what the movement
// misses the target by corrects that. False where it did not settle.
template <class Real>
bool findWeights(const ControlProblem& system, const Gramian<Real>& gramian, const std::vector<Real>& target,
                 EnergyMovement<Real>& movement, std::vector<Real>& weights, double& miss) {
  const typename Gramian<Real>::Solution solution = gramian.solve(target);
  weights = solution.weights;
  const double wanted = gramian.condition() < Precision<Real>::kNeedsNoCorrection
                            ? 0
                            : Precision<Real>::kCorrected * Precision<Real>::kCorrected * solution.energy;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    std::vector<Real> missed = movement.follow(weights);
    miss = 0;
    for (int i = 0; i < system.controlled; ++i) {
      missed[i] = target[i] - missed[i];
      miss = std::max(miss, std::abs(leading(missed[i])));
    }
    if (wanted == 0 || !std::isfinite(miss)) return true;
    const typename Gramian<Real>::Solution correction = gramian.solve(missed);
    if (correction.energy <= wanted) return true;
    for (int i = 0; i < system.size; ++i) weights[i] += correction.weights[i];
  }
  return false;
}

// In these digits; nullopt where they are too few.
template <class Real>
std::optional<MinimumEnergyMotion> solveIn(const ControlProblem& system, const SparseRows& a, double duration) {
  MinimumEnergyMotion motion;
  motion.fastest = a.norm();
  const int doublings = std::max(1, static_cast<int>(std::ceil(std::log2(motion.fastest * duration / kShort))));
  const int toHalf = std::min(doublings - 1, kHalfDoublings);
  std::pmr::monotonic_buffer_resource memory(kFirstMemory);
  Span<Real> span = makeShortSpan<Real>(system, a, std::ldexp(duration, -doublings), &memory);
  Doubling<Real> doubling(&memory, system.size);
  for (int i = 0; i < toHalf; ++i) doubling.apply(span);
  LaneMatrix<Real> half = span.e.copy();
  doubling.apply(span);
  const LaneMatrix<Real> whole = span.e.copy();
  for (int i = toHalf + 1; i < doublings; ++i) doubling.apply(span);

  const Gramian<Real> gramian(system, span.w);
  motion.condition = gramian.condition();
  if (std::is_same_v<Real, double> && !(motion.condition <= Precision<double>::kMaxCondition)) return std::nullopt;
  const int intervals = 1 << (doublings - toHalf - 1);
  const double halfWidth = duration / (2 * intervals);
  EnergyMovement<Real> movement(system, a, intervals, halfWidth, std::move(half), whole,
                                std::clamp(motion.condition, 1.0, kRefuseCondition));
  std::vector<Real> target;
  target.reserve(system.target.size());
  for (const DoubleDouble& x : system.target) target.push_back(rounded<Real>(x));
  std::vector<Real> weights;
  const bool settled = findWeights(system, gramian, target, movement, weights, motion.miss);
  if (std::is_same_v<Real, double> && !(settled && std::isfinite(motion.miss))) return std::nullopt;
  Real cost = 0.0;
  for (int i = 0; i < system.controlled; ++i) cost += weights[i] * target[i];
  motion.cost = static_cast<double>(cost);
  motion.profile = makeProfile(system, a, movement, intervals, halfWidth, &memory);
  return motion;
}

}  // namespace

MinimumEnergyMotion solveMinimumEnergy(const ControlProblem& system, double duration) {
  const SparseRows a(system);
  if (const double fastest = a.norm(); !(fastest * duration <= kFastestTimesDuration))
    throw RefusedError(
        fmt::format("the object's fastest rate, {:.3g} 1/s, is too stiff for a movement of {:.4g} s: less damping, "
                    "heavier masses or a shorter time",
                    fastest, duration));
  if (std::optional<MinimumEnergyMotion> motion = solveIn<double>(system, a, duration)) return *std::move(motion);
  return *solveIn<DoubleDouble>(system, a, duration);
}

}  // namespace reachlab::predict
