#include "sim/dynamics/rk4_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math/minimum_jerk.h"
#include "constraints/geometry/task_path.h"
#include "sim/dynamics/hand/hand_function.h"

namespace reachlab::dynamics {
namespace {

constexpr double kMaxSteps = 1e5;

/// Places of all masses at every `per`-th step, up to the first that fails.
std::vector<Vec3> drive(Plant& plant, const experiment::Task& task, const HandFunction& hand, double dt, int steps, int per) {
  plant.placeAtRest(task.start);
  std::vector<MassState> masses(static_cast<std::size_t>(plant.massCount()));
  std::vector<Vec3> places;
  for (int i = 0; i < steps; ++i) {
    if (plant.step(makeSegment(hand, i * dt, dt), dt) != StepStatus::Ok) break;
    if ((i + 1) % per != 0) continue;
    plant.observe(hand((i + 1) * dt), masses);
    for (const MassState& mass : masses) places.push_back(mass.r);
  }
  return places;
}

}  // namespace

std::optional<double> measureRk4Error(Plant& plant, const experiment::Task& task, const constraints::Constraint& constraint, double step) {
  if (!(task.duration > 0) || task.duration / step > kMaxSteps) return {};
  const Vec3 start = placeOn(constraint, task.start), chord = placeOn(constraint, task.target) - start;
  if (!isFinite(chord) || !(norm(chord) > 0)) return {};
  const HandFunction hand = [&](double t) {
    const MinimumJerk law = heldMinimumJerk(t / task.duration);
    return HandSample{start + law.value * chord, (law.rate / task.duration) * chord, true};
  };
  const int steps = std::max(1, static_cast<int>(std::ceil(task.duration / step)));
  const std::vector<Vec3> whole = drive(plant, task, hand, step, steps, 1), halves = drive(plant, task, hand, step / 2, 2 * steps, 2);
  plant.placeAtRest(task.start);
  if (whole.empty() || halves.empty()) return std::numeric_limits<double>::infinity();  // the first step fails
  double most = 0;
  for (std::size_t i = 0; i < std::min(whole.size(), halves.size()); ++i) most = std::max(most, norm(whole[i] - halves[i]));
  return most * 16 / 15;
}

}  // namespace reachlab::dynamics
