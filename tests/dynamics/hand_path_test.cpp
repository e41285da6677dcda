#include "sim/dynamics/hand/hand_path.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

/// Largest error of the five-mass chain over a reach when the hand comes as samples, interpolated through the last `samples`.
double interpolationError(int samples) {
  const Scene sampled = compileScene(makeChain(5, 0.6, 600)), exact = compileScene(makeChain(5, 0.6, 600));
  for (const Scene* scene : {&sampled, &exact}) scene->plant->placeAtRest(std::array{0.0});
  HandPath path(samples);
  path.push(reachAt(0));
  double worst = 0;
  for (int i = 0; i < 1350; ++i) {
    path.push(reachAt((i + 1) * 1e-3));
    if (sampled.plant->step(path.segment(), 1e-3) != StepStatus::Ok ||
        exact.plant->step(makeSegment(reachAt, i * 1e-3, 1e-3), 1e-3) != StepStatus::Ok)
      return std::numeric_limits<double>::infinity();
    const auto a = observed(*sampled.plant), b = observed(*exact.plant);
    for (int m = 0; m < 5; ++m) worst = std::max(worst, norm(a[m].r - b[m].r));
  }
  return worst;
}

// What the hold and each degree cost, within a factor of two of what was measured when the method was designed.
TEST(HandPath, InterpolationCostsWhatIsPromised) {
  EXPECT_NEAR(std::log2(interpolationError(1) / 2e-4), 0, 1) << "held";
  EXPECT_NEAR(std::log2(interpolationError(2) / 1e-7), 0, 1) << "line";
  EXPECT_NEAR(std::log2(interpolationError(3) / 5e-10), 0, 1) << "parabola";
  EXPECT_LT(interpolationError(4), 8e-11) << "cubic";
}

HandSample along(double x) { return {{x, 0.4 * x, -0.7 * x}, {3 * x, 2 - x, 5 * x * x}, true}; }

TEST(HandPath, AHandMayMoveByTwentyMillimetresInATick) {
  for (const double jump : {0.02, 0.5}) {
    HandPath path = jump == 0.02 ? HandPath() : HandPath(4, jump);
    path.push({{0, 0, 0}, {}, true});
    EXPECT_TRUE(path.push({{jump, 0, 0}, {}, true}));
    EXPECT_TRUE(path.push({{jump, 0.6 * jump, 0.79 * jump}, {}, true})) << "in any direction";
    EXPECT_FALSE(path.push({{jump, 0.6 * jump, 1.8 * jump}, {}, true}));
  }
}

TEST(HandPath, TheDegreeRisesWithTheSamplesUpToWhatIsAsked) {
  for (int most = 1; most <= 4; ++most) {
    HandPath path(most, 1);
    EXPECT_EQ(path.samples(), 0);
    EXPECT_EQ(path.segment().degree, 0);
    for (int i = 1; i <= 6; ++i) {
      path.push(along(0.01 * i));
      EXPECT_EQ(path.samples(), std::min(i, most));
      EXPECT_EQ(path.segment().degree, path.samples() - 1);
    }
  }
}

TEST(HandPath, EveryComponentGoesThroughItsOwnSamples) {
  for (int most = 1; most <= 4; ++most) {
    HandPath path(most, 1);
    const std::array x{0.05, 0.01, 0.04, -0.02, 0.03};
    for (const double at : x) path.push(along(at));
    for (int back = 0; back < most; ++back) {
      const HandSample expected = along(x[4 - back]), found = sampleAt(path.segment(), 1.0 - back);
      EXPECT_LT(norm(found.position - expected.position), 1e-15) << most << " samples, " << back << " ago";
      EXPECT_LT(norm(found.velocity - expected.velocity), 1e-14) << most << " samples, " << back << " ago";
      EXPECT_EQ(sampleAt(path.segment(false), 1.0 - back).position, found.position);
    }
    EXPECT_EQ(endOf(path.segment(false)).velocity, Vec3{}) << "for who does not look at it";
  }
}

TEST(HandPath, BehindAJumpThePathGrowsAnew) {
  HandPath path;
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(path.push({{0.001 * i, 0, 0}, {}, true}));
  EXPECT_FALSE(path.push({{0.1, 0, 0}, {}, true}));
  EXPECT_EQ(path.samples(), 2) << "straight across";
  EXPECT_NEAR(endOf(path.segment()).position.x, 0.1, 1e-17);
  for (const int samples : {2, 3, 4, 4}) {
    EXPECT_TRUE(path.push({{0.1, 0, 0}, {}, true}));
    EXPECT_EQ(path.samples(), samples);
    EXPECT_LT(norm(sampleAt(path.segment(), 0.5).position - Vec3{0.1, 0, 0}), 1e-17) << "nothing from before the jump";
  }
}

TEST(HandPath, BehindALostHandThePathBeginsAtTheLastGoodPlace) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const HandSample& bad :
       {HandSample{{0.012, 0, 0}, {}, false}, HandSample{{none, 0, 0}, {}, true}, HandSample{{0.012, 0, 0}, {0, none, 0}, true}})
    for (const bool afterJump : {false, true}) {
      HandPath path;
      EXPECT_FALSE(path.push(bad));
      EXPECT_EQ(path.samples(), 0) << "nothing good yet";
      for (int i = 0; i < 4; ++i) path.push({{0.001 * i, 0, 0}, {}, true});
      if (afterJump) path.push({{0.05, 0, 0}, {}, true});
      EXPECT_FALSE(path.push(bad));
      EXPECT_EQ(path.samples(), 1) << "held";
      const double last = endOf(path.segment()).position.x;
      EXPECT_EQ(last, afterJump ? 0.05 : 0.003);
      EXPECT_TRUE(path.push({{last + 0.001, 0, 0}, {}, true}));
      EXPECT_EQ(path.samples(), 2);
      EXPECT_EQ(startOf(path.segment()).position.x, last);
    }
}

TEST(HandPath, AForgottenPathHoldsItsNextSample) {
  for (const bool afterJump : {false, true}) {
    HandPath path;
    for (int i = 0; i < 3; ++i) path.push({{0.001 * i, 0, 0}, {}, true});
    if (afterJump) path.push({{0.1, 0, 0}, {}, true});
    path.reset();
    EXPECT_EQ(path.samples(), 0);
    EXPECT_TRUE(path.push({{0.5, 0, 0}, {}, true})) << "no jump from what is forgotten";
    EXPECT_EQ(path.segment().degree, 0);
    EXPECT_EQ(startOf(path.segment()).position.x, 0.5);
  }
}

// Chains by their propagator (two masses) and in their modes (five), a mass on a circle by a method that needs the velocity in any case.
TEST(HandPath, APlantThatNeedsNoVelocityMovesTheSameToTheBitWithoutIt) {
  for (const double damping : {0.0, 3.0})
    for (const int count : {2, 5, 1}) {
      experiment::Experiment experiment = makeChain(count, 0.6, 600, {600, damping});
      if (count == 1) experiment = onCurve(experiment, "0.1*cos(phi)", "0.1*sin(phi)", "0");
      const Scene with = compileScene(experiment), asNeeded = compileScene(experiment);
      for (const Scene* scene : {&with, &asNeeded}) scene->plant->placeAtRest(std::array{0.0});
      const bool needed = asNeeded.plant->needsHandVelocity();
      EXPECT_EQ(needed, damping != 0 || count == 1);
      HandPath path;
      for (int i = 0; i < 500; ++i) {
        path.push(reachAt(i * 1e-3));
        ASSERT_EQ(with.plant->step(path.segment(), 1e-3), StepStatus::Ok);
        ASSERT_EQ(asNeeded.plant->step(path.segment(needed), 1e-3), StepStatus::Ok);
      }
      const auto a = observed(*with.plant), b = observed(*asNeeded.plant);
      for (int m = 0; m < count; ++m) {
        EXPECT_EQ(a[m].r, b[m].r) << count << " masses, " << damping << " N s/m";
        EXPECT_EQ(a[m].v, b[m].v) << count << " masses, " << damping << " N s/m";
      }
    }
}

}  // namespace
}  // namespace reachlab::dynamics
