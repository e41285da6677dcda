// The Gramian by doubling: what it says of itself, and its limits. Its error stands in reference_test.cpp.
#include "sim/predict/line/minimum_energy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

constexpr double kDistance = 0.2;  // [m]
constexpr double kMiss = 2e-9;     // of any state [m, m/s, sqrt(J)]; 5e-10 measured where the condition is 9e11

LineObject dampedChain(int n, double mass, double stiffness, double damping) {
  return makeLineObject(damped(makeChain(n, mass, stiffness, 1), damping, damping), 0, 0);
}

MinimumEnergyMotion solve(const LineObject& object, Criterion criterion, double duration) {
  return solveMinimumEnergy(makeControlProblem(object, criterion, kDistance), duration);
}

// The states that the control leads to, in 32 digits, against those that were asked for.
TEST(MinimumEnergy, ArrivesUpToTheRefusedCondition) {
  struct Movement {
    int masses;
    double mass, stiffness, damping, duration;
  };
  double most = 0;
  for (const Movement& m : {Movement{1, 3, 120, 2, 1.35},
                            {5, 0.6, 600, 2, 1.35},
                            {10, 0.3, 600, 2, 1.35},
                            {10, 0.3, 60, 1, 1.35},
                            {10, 0.3, 60, 0.2, 0.9},
                            {15, 0.2, 600, 4, 1.35}}) {
    const MinimumEnergyMotion motion = solve(dampedChain(m.masses, m.mass, m.stiffness, m.damping), Criterion::MinHandJerk, m.duration);
    EXPECT_LT(motion.miss, kMiss) << m.masses << " masses, condition " << motion.condition;
    most = std::max(most, motion.condition);
  }
  EXPECT_GT(most, 1e11) << "the cases do not reach the refused condition";
}

TEST(MinimumEnergy, TakesVeryFastRatesUpToItsLimit) {
  const LineObject object = dampedChain(2, 1, 600, 3000);
  EXPECT_LT(solve(object, Criterion::MinHandForce, 1.35).miss, kMiss);
  EXPECT_THROW(solve(object, Criterion::MinHandForce, 13.5), RefusedError);
}

TEST(MinimumEnergy, ASlowMovementOfOneMassIsThatOfItsRates) {
  // Rates times duration far below one: a single interval.
  const MinimumEnergyMotion motion = solve(dampedChain(1, 100, 0.1, 0.1), Criterion::MinComAcceleration, 0.02);
  EXPECT_EQ(motion.profile.intervals, 1);
  EXPECT_NEAR(motion.cost / (12 * kDistance * kDistance / std::pow(0.02, 3)), 1, 1e-9);
}

TEST(PiecewiseSeries, SamplesAreItsVelocities) {
  const PiecewiseSeries profile = solve(dampedChain(5, 0.6, 600, 2), Criterion::MinHandJerk, 1.35).profile;
  for (const size_t count : {2, 9, 100, 333}) {
    std::vector<double> velocity(count);
    profile.sampleVelocity(3, 1.35, velocity);
    for (size_t i = 0; i < count; ++i)
      EXPECT_NEAR(velocity[i], profile.evaluate(3, 1.35 * static_cast<double>(i) / static_cast<double>(count - 1)).velocity, 1e-13);
  }
}

}  // namespace
}  // namespace reachlab::predict
