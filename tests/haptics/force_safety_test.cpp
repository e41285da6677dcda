#include "sim/haptics/force_safety.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/haptics/hand_guard.h"

namespace reachlab::haptics {
namespace {

constexpr double kRounding = 1e-12;  // [N] a few operations on numbers of about 10

// Past the ramp, at rest on `force`.
ForceSafety settled(double limit, const Vec3& force) {
  ForceSafety safety({limit});
  for (int i = 0; i < 300; ++i) safety.limit(force, true, true);
  return safety;
}

TEST(ForceSafety, ClampsTheNormAndKeepsTheDirection) {
  const Vec3 force{30, -40, 0};
  ForceSafety safety = settled(10, force);
  const Vec3 out = safety.limit(force, true, true);
  EXPECT_NEAR(out.x, 6, kRounding);
  EXPECT_NEAR(out.y, -8, kRounding);
  EXPECT_EQ(out.z, 0);
}

TEST(ForceSafety, GrowsFromZeroWhenATrialEngages) {
  ForceSafety safety({10});
  double last = 0;
  for (int tick = 1; tick <= 200; ++tick) {
    const double size = norm(safety.limit({100, 0, 0}, true, true));
    EXPECT_NEAR(size, 10.0 * tick / 200, kRounding);
    EXPECT_GT(size, last);
    last = size;
  }
}

TEST(ForceSafety, IsZeroAtOnceWhenNotEngagedOrTheHandIsNotHeldAndRampsAfterwards) {
  for (const bool engaged : {false, true}) {
    ForceSafety safety = settled(10, {5, 0, 0});
    EXPECT_EQ(safety.limit({5, 0, 0}, engaged, !engaged), Vec3{});
    EXPECT_NEAR(norm(safety.limit({5, 0, 0}, true, true)), 10.0 / 200, kRounding);
  }
}

TEST(ForceSafety, LatchesOnWhatIsNotANumberUntilRearmed) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ForceSafety safety = settled(10, {5, 0, 0});
    EXPECT_EQ(safety.limit({0, bad, 0}, true, true), Vec3{});
    EXPECT_TRUE(safety.latched());
    EXPECT_EQ(safety.limit({5, 0, 0}, true, true), Vec3{});
    safety.rearm();
    EXPECT_GT(norm(safety.limit({5, 0, 0}, true, true)), 0);
  }
}

TEST(ForceSafety, AHugeForceIsStillTheLimit) {
  ForceSafety safety = settled(10, {1e200, 0, 0});
  EXPECT_LE(norm(safety.limit({1e200, 1e200, 0}, true, true)), 10 + kRounding);
}

// A steady force leaves h(n) = F^2 (1 - (1 - dt/tau)^n), which fades by the same factor while no force is given.
TEST(ForceSafety, HeatFollowsItsLawUpAndDown) {
  constexpr double kContinuous = 2, kTau = 3, kForce = 1.5, kStep = 1 - 1e-3 / kTau;
  ForceSafety safety({7, kContinuous, kTau});
  for (int tick = 0; tick < 300; ++tick) safety.limit({}, true, true);
  EXPECT_EQ(safety.heat(), 0);
  for (int tick = 1; tick <= 2000; ++tick) {
    safety.limit({0, kForce, 0}, true, true);
    ASSERT_NEAR(safety.heat(), kForce * kForce / (kContinuous * kContinuous) * (1 - std::pow(kStep, tick)), kRounding) << tick;
  }
  const double warm = safety.heat();
  for (int tick = 1; tick <= 2000; ++tick) {
    safety.limit({0, kForce, 0}, tick % 2 == 0, false);
    ASSERT_NEAR(safety.heat(), warm * std::pow(kStep, tick), kRounding) << tick;
  }
}

// Between 80 and 100 % of the budget the square of the limit falls evenly from the peak's to the continuous force's.
TEST(ForceSafety, TheBudgetTakesTheForceDownAlongItsLaw) {
  constexpr double kPeak = 6, kContinuous = 2;
  ForceSafety safety({kPeak, kContinuous, 0.5});
  for (int tick = 0; tick < 300; ++tick) safety.limit({}, true, true);
  double last = 0;
  int full = 0, between = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    const double used = std::min(std::max((safety.heat() - 0.8) / 0.2, 0.0), 1.0);
    const double bound = std::sqrt(kPeak * kPeak - used * (kPeak * kPeak - kContinuous * kContinuous));
    const double felt = norm(safety.limit({0, 0, -20}, true, true));
    ASSERT_NEAR(felt, std::min(bound, last + ForceSafety::kSlewPerTick), 1e-9) << tick;
    EXPECT_EQ((safety.interventions() & intervention::kHeat) != 0, used > 0) << tick;
    EXPECT_EQ((safety.interventions() & intervention::kLimit) != 0, used == 0) << tick;
    (used > 0 ? between : full) += 1;
    last = felt;
  }
  EXPECT_GT(full, 10);
  EXPECT_GT(between, 10);
  EXPECT_NEAR(last, kContinuous, 1e-3);
}

TEST(ForceSafety, ADeviceThatStandsItsPeakForEverIsNeverWornDown) {
  for (const double continuous : {0.0, 5.0, 6.0}) {
    ForceSafety safety({5, continuous, 0.1});
    for (int tick = 0; tick < 2000; ++tick) safety.limit({20, 0, 0}, true, true);
    EXPECT_NEAR(norm(safety.limit({20, 0, 0}, true, true)), 5, kRounding) << continuous;
    EXPECT_NEAR(safety.heat(), continuous > 0 ? 25 / (continuous * continuous) : 0, 1e-6) << "kept where the continuous force is known";
  }
}

TEST(ForceSafety, AStepBeyondTheSlewKeepsItsDirection) {
  ForceSafety safety = settled(12, {1, 2, -3});
  const Vec3 step = safety.limit({4, -2, -3}, true, true) - Vec3{1, 2, -3};
  EXPECT_NEAR(step.x, 0.6 * ForceSafety::kSlewPerTick, kRounding);
  EXPECT_NEAR(step.y, -0.8 * ForceSafety::kSlewPerTick, kRounding);
  EXPECT_NEAR(step.z, 0, kRounding);
  EXPECT_EQ(safety.interventions(), intervention::kSlew);
}

TEST(ForceSafety, AStepOfExactlyTheSlewIsTakenWhole) {
  ForceSafety safety = settled(12, {1, 0, 0});
  EXPECT_EQ(safety.limit({3, 0, 0}, true, true), (Vec3{3, 0, 0}));
  EXPECT_EQ(safety.interventions(), 0);
}

TEST(ForceSafety, TheRampBeginsAnewAfterEachTickWithoutForce) {
  ForceSafety safety = settled(10, {5, 0, 0});
  safety.limit({5, 0, 0}, true, false);
  for (int tick = 1; tick <= 7; ++tick) safety.limit({5, 0, 0}, true, true);
  safety.limit({5, 0, 0}, false, true);
  EXPECT_EQ(safety.interventions(), 0) << "between trials nothing is held back";
  EXPECT_NEAR(norm(safety.limit({5, 0, 0}, true, true)), 10.0 / 200, kRounding);
  EXPECT_EQ(safety.interventions(), intervention::kRamp);
  EXPECT_EQ(ForceSafety::kRampSeconds, 0.2);
}

TEST(ForceSafety, ALatchIsSaidAsLongAsItHolds) {
  ForceSafety safety = settled(10, {5, 0, 0});
  EXPECT_FALSE(safety.latched());
  safety.limit({0, 0, std::numeric_limits<double>::quiet_NaN()}, false, true);
  safety.limit({5, 0, 0}, true, false);
  EXPECT_EQ(safety.interventions(), intervention::kNotFinite);
  safety.rearm();
  EXPECT_FALSE(safety.latched());
}

TEST(ForceSafety, SaysLimitAndNotRampOnceTheRampIsOver) {
  for (const double limit : {3.0, 5.0, 6.0, 12.0}) {  // three of them are no multiple of 1/200 to the bit
    ForceSafety safety({limit});
    for (int tick = 1; tick <= 300; ++tick) {
      safety.limit({0, 50, 0}, true, true);
      ASSERT_EQ(safety.interventions(), tick < 200 ? intervention::kRamp : intervention::kLimit) << limit << " N, tick " << tick;
    }
  }
}

}  // namespace
}  // namespace reachlab::haptics
