#include <gtest/gtest.h>

#include <algorithm>

#include "base/math/minimum_jerk.h"
#include "constraints/catalogue/definition.h"
#include "constraints/geometry/task_path.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

constexpr double kTooLow = 3;               // times: how far the estimate may fall short of the truth
constexpr double kLongStep = 0.01;          // [s] long enough for errors far above rounding
constexpr double kNegligibleError = 1e-10;  // [m]

/// Largest distance from the adaptive method's places over the reach along the chord.
double trueError(const experiment::Experiment& e) {
  const experiment::Task& task = *e.task;
  Scene rk4 = compileScene(e, {"rk4", kLongStep, 0}), exact = compileScene(e, {"adaptive", kLongStep, 0});
  const constraints::Constraint& c = *rk4.constraint;
  const Vec3 start = placeOn(c, task.start), chord = placeOn(c, task.target) - start;
  const HandFunction hand = [&](double t) {
    const MinimumJerk law = heldMinimumJerk(t / task.duration);
    return HandSample{start + law.value * chord, (law.rate / task.duration) * chord, true};
  };
  double most = 0;
  std::vector<MassState> a(1), b(1);
  for (int i = 0; i < static_cast<int>(task.duration / kLongStep); ++i) {
    const HandSegment segment = makeSegment(hand, i * kLongStep, kLongStep);
    if (rk4.plant->step(segment, kLongStep) != StepStatus::Ok || exact.plant->step(segment, kLongStep) != StepStatus::Ok) break;
    rk4.plant->observe({}, a);
    exact.plant->observe({}, b);
    most = std::max(most, norm(a[0].r - b[0].r));
  }
  return most;
}

TEST(Rk4Error, IsForetoldToAFactorOfThreeOnTheCatalogue) {
  int judged = 0;
  for (const constraints::Definition& d : constraints::catalogue()) {
    experiment::Experiment e = from(makePoint(1, {600, 5}), d.start, d.target);
    e.constraint.name = d.name;
    double foretold = 0;
    try {
      foretold = compileScene(e, {"rk4", kLongStep, 0}).choice.predictedError;
    } catch (const std::exception&) {
      continue;  // refused in words: a start on a cusp, say
    }
    const double error = trueError(e);
    if (error < kNegligibleError) continue;
    ++judged;
    EXPECT_GT(foretold * kTooLow, error) << d.name;
  }
  EXPECT_GT(judged, 20);
}

}  // namespace
}  // namespace reachlab::dynamics
