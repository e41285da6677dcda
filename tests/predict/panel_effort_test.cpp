// The quick way to damped predictions against the slow one, which shares the equations of motion with it and nothing else.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/predict/panel_effort.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

constexpr double kDistance = 0.2;     // [m]
constexpr double kOfThePeak = 1e-11;  // of the largest speed of hand or masses

LineObject dampedChain(int n, double mass, double stiffness, double damping) {
  experiment::Experiment e = makeChain(n, mass, stiffness, 1);
  for (double& b : e.object.damping) b = damping;
  e.coupling->damping = damping;
  return makeLineObject(e, 0, 0);
}

double largestDifference(const SeriesProfile& a, const SeriesProfile& b, double duration) {
  double difference = 0, peak = 0;
  for (int output = 0; output < a.outputs; ++output)
    for (int i = 0; i <= 64; ++i) {
      const double t = duration * i / 64, exact = b.evaluate(output, t).velocity;
      peak = std::max(peak, std::abs(exact));
      difference = std::max(difference, std::abs(a.evaluate(output, t).velocity - exact));
    }
  return difference / peak;
}

struct Movement {
  int masses;
  double mass, stiffness, damping, duration;
};

TEST(PanelEffort, RefinedIsTheSolutionInDoubleDoubleUpToTheRefusedCondition) {
  double most = 0;
  for (const Movement& m : {Movement{10, 0.3, 600, 2, 1.35}, {10, 0.3, 60, 0.2, 0.9}, {10, 0.3, 60, 1, 1.35}, {15, 0.2, 600, 4, 1.35}}) {
    const LineObject object = dampedChain(m.masses, m.mass, m.stiffness, m.damping);
    const auto wide = makeLineSystem<DoubleDouble>(object, Criterion::MinHandJerk, kDistance);
    const auto panels = PanelEffort::make(makeLineSystem<double>(object, Criterion::MinHandJerk, kDistance), m.duration);
    ASSERT_TRUE(panels);
    const auto refined = panels->refine(wide);
    ASSERT_TRUE(refined) << panels->condition();
    const LeastEffort slow = solveLeastEffort(wide, m.duration);
    const double difference = largestDifference(refined->profile, slow.profile, m.duration);
    std::printf("[ measured ] %d masses, condition %.1e: differs by %.1e of the peak\n", m.masses, panels->condition(), difference);
    EXPECT_LT(difference, kOfThePeak);
    EXPECT_NEAR(refined->cost / slow.cost, 1, kOfThePeak);
    most = std::max(most, panels->condition());
  }
  EXPECT_GT(most, 1e11) << "the cases do not reach the refused condition";
}

TEST(PanelEffort, ReportsTheConditionOfTheSlowWay) {
  for (const int n : {1, 2, 5, 10}) {
    LineSystem<double> system = makeLineSystem<double>(dampedChain(n, 3.0 / n, 600, 2), Criterion::MinHandJerk, kDistance);
    const double condition = PanelEffort::make(system, 1.35)->condition();
    rotateToModes(system);
    // Relative error eps times the condition, and what rounding of the two sets of modes adds.
    EXPECT_NEAR(solveLeastEffort(system, 1.35).condition / condition, 1, 1e-9) << n;
  }
}

TEST(PanelEffort, LeavesObjectsWithVeryFastRatesToTheSlowWay) {
  const LineObject object = dampedChain(2, 1, 600, 3000);
  const LineSystem<double> system = makeLineSystem<double>(object, Criterion::MinHandForce, kDistance);
  EXPECT_FALSE(PanelEffort::make(system, 1.35));
  EXPECT_TRUE(PanelEffort::make(system, 0.1));
}

TEST(SeriesProfile, SamplesAreItsVelocities) {
  const LineObject object = dampedChain(5, 0.6, 600, 2);
  const auto panels = PanelEffort::make(makeLineSystem<double>(object, Criterion::MinHandJerk, kDistance), 1.35);
  const SeriesProfile profile = panels->solve().profile;
  for (const size_t count : {2, 9, 100, 333}) {
    std::vector<double> velocity(count);
    profile.sampleVelocity(3, 1.35, velocity);
    for (size_t i = 0; i < count; ++i)
      EXPECT_NEAR(velocity[i], profile.evaluate(3, 1.35 * static_cast<double>(i) / static_cast<double>(count - 1)).velocity, 1e-13);
  }
}

}  // namespace
}  // namespace reachlab::predict
