#include "sim/subjects/plans/reach_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/experiment/experiment.h"

namespace reachlab::subjects {
namespace {

constexpr double kRadius = 0.15, kAngle = 1.3;  // [m], [rad]

// Too soft and quick for a prediction along a bent way.
experiment::Experiment softChain() {
  experiment::Experiment e = experiment::readExperiment("chain-fast");
  e.object.stiffness.assign(e.object.stiffness.size(), 120);
  e.task->duration = 0.7;
  return e;
}

// A hand that pulls such a chain goes past the target and comes back. On a curve it is the hand of a line as long, and beyond the ends of the
// way the circle goes on at its own pace.
TEST(ReachPlan, GoesOnBeyondTheEndsOfACurveAsOnALine) {
  experiment::Experiment onCircle = softChain(), onLine = softChain();
  onCircle.constraint = {.name = {}, .curve = {"R*cos(phi)", "R*sin(phi)", "0"}, .surface = {}, .shape = {{"R", kRadius}}};
  onCircle.task->start = {0.4};
  onCircle.task->target = {0.4 + kAngle};
  onLine.constraint.shape = {{"length_m", kRadius * kAngle}};
  onLine.task->start = {0};
  onLine.task->target = {2 * std::numbers::pi};
  const experiment::CompiledExperiment bent(onCircle), straight(onLine);
  const ReachPlan circle = makeReachPlan(bent, std::nullopt, std::nullopt), line = makeReachPlan(straight, std::nullopt, std::nullopt);
  ASSERT_NEAR(circle.duration, line.duration, 1e-9);
  const Vec3 from = line.handAt(0), to = line.handAt(line.duration);
  double farthest = 0;
  for (double t = 0; t < line.duration; t += 0.01) {
    const double along = dot(line.handAt(t) - from, to - from) / norm(to - from), phi = 0.4 + along / kRadius;
    EXPECT_LT(norm(circle.handAt(t) - kRadius * Vec3{std::cos(phi), std::sin(phi), 0}), 1e-9) << t;
    farthest = std::max(farthest, along);
  }
  EXPECT_GT(farthest, kRadius * kAngle + 1e-3) << "the case is met";
}

// A hand without mass jumps at both ends of these predictions. The person begins and ends at rest, where the task says.
TEST(ReachPlan, BeginsAtTheStartAndEndsAtTheTargetUnderEveryCriterion) {
  using predict::Criterion;
  for (const auto& [name, criterion] : {std::pair{"chain-moderate", Criterion::MinHandForce},
                                        {"dingwell", Criterion::MinComAcceleration},
                                        {"dingwell", Criterion::MinHandForceChange}}) {
    const experiment::CompiledExperiment experiment{experiment::readExperiment(name)};
    const ReachPlan jerk = makeReachPlan(experiment, Criterion::MinHandJerk, 0.0), plan = makeReachPlan(experiment, criterion, 0.0);
    EXPECT_LT(norm(plan.handAt(0) - jerk.handAt(0)), 1e-12) << name << ' ' << predict::nameOf(criterion);
    EXPECT_LT(norm(plan.handAt((1 - 1e-15) * plan.duration) - jerk.handAt(jerk.duration)), 1e-9)
        << name << ' ' << predict::nameOf(criterion);
  }
}

}  // namespace
}  // namespace reachlab::subjects
