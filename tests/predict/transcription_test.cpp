// The parts that the predictions found by iteration are made of: each by its own law, derivatives by differences.
#include "sim/predict/transcription/transcription.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "sim/predict/numerics/hyper_dual.h"
#include "sim/predict/transcription/path_check.h"
#include "tests/predict/objects.h"
#include "tests/refusal.h"

namespace reachlab::predict {
namespace {

TEST(Transcription, TheErrorOfAProfileFallsGeometrically) {
  EXPECT_NEAR(estimateError(1e-4, 1e-2), 1e-4 * 1e-3, 1e-20);
  EXPECT_EQ(estimateError(1e-4, 1e-4), 1e-4);
  EXPECT_EQ(estimateError(1e-4, 0), 1e-4) << "nothing is known of a first raise";
  EXPECT_NEAR(boundError(1e-4, 1e-2), 1e-6, 1e-20);
  EXPECT_EQ(boundError(1e-4, 1e-5), 1e-4);
  EXPECT_EQ(boundError(1e-14, 1e-2), 1e-12);
}

TEST(Transcription, AMotionOfAVelocityHasItsIntegralAndItsSlope) {
  constexpr double T = 1.7;
  // v(x) = 1 + 2 x + 3 x^2 - x^4 over x = 2t/T - 1.
  const auto velocity = [](double x) { return 1 + 2 * x + 3 * x * x - std::pow(x, 4); };
  const auto integral = [](double x) { return x + x * x + x * x * x - std::pow(x, 5) / 5; };
  const MotionSeries series = makeSeriesOfSpeed([&](double t) { return velocity(2 * t / T - 1); }, 6, T);
  for (const double x : {-1.0, -0.4, 0.25, 1.0}) {
    EXPECT_NEAR(valueAt(series.velocity, x), velocity(x), 1e-12);
    EXPECT_NEAR(valueAt(series.position, x), T / 2 * (integral(x) - integral(-1)), 1e-12);
    EXPECT_NEAR(valueAt(series.acceleration, x), 2 / T * (2 + 6 * x - 4 * x * x * x), 1e-8);
  }
}

TEST(Transcription, WhatIsSaidOfAMotionIsWhatIsKnown) {
  TranscribedMotion motion{RestToRestBasis(3, 7), {{1}}, {0}, 1};
  motion.cost = 5;
  motion.condition = 20;
  const auto describe = [&] {
    auto p = makeLegendrePrediction({{0, 1}, {1}, {0}}, {{{0, 1}, {1}, {0}}}, 1);
    describeMotion(motion, *p);
    return p;
  };
  EXPECT_EQ(describe()->cost, 5);
  EXPECT_EQ(describe()->condition, 20);
  EXPECT_EQ(describe()->profileError, std::nullopt);
  EXPECT_TRUE(describe()->warnings.empty());
  EXPECT_EQ(describe()->handJump, 0);
  EXPECT_EQ(describe()->handVelocityJump, 0);
  motion.errorBound = 3e-9;
  motion.uncertainty = 1.9e-9;
  EXPECT_EQ(describe()->profileError, 3e-9);
  EXPECT_TRUE(describe()->warnings.empty());
  motion.uncertainty = 2e-9;
  ASSERT_EQ(describe()->warnings.size(), 1u);
  EXPECT_TRUE(holds(describe()->warnings[0], "known to 3e-09 of its peak only: the path bends too sharply for 7 unknowns"));
}

PathPoint pointOnCircle(double t) {
  constexpr double r = 0.3, w = 2;
  const double s = std::sin(w * t), c = std::cos(w * t);
  return {{r * c, r * s, 0}, {-r * w * s, r * w * c, 0}, {-r * w * w * c, -r * w * w * s, 0}, {r * w * w * w * s, -r * w * w * w * c, 0}};
}

TEST(PathCheck, AMovementWhoseDerivativesBelongTogetherIsSmooth) {
  const PathCheck check = checkPath(1.4, pointOnCircle);
  EXPECT_TRUE(check.smooth);
  EXPECT_NEAR(check.cost, std::pow(0.3 * 8, 2) * 1.4, 1e-12) << "the square of its jerk, which does not change";
  EXPECT_EQ(check.brokenAt, 0);
  const PathCheck nothing;
  EXPECT_TRUE(nothing.smooth);
  EXPECT_EQ(nothing.cost + nothing.brokenAt, 0);
}

// In an interval of 1.4 s / 96; each derivative is broken by itself, at either end of the movement and within.
TEST(PathCheck, TellsWhereADerivativeIsNotTheIntegralOfTheNext) {
  for (int kind = 0; kind < 4; ++kind)
    for (const double place : {0.005, 0.7, 0.931, 1.39}) {
      const auto broken = [&](double t) {
        PathPoint p = pointOnCircle(t);
        Vec3& part = kind == 0 ? p.r : kind == 1 ? p.velocity : kind == 2 ? p.acceleration : p.jerk;
        if (kind < 3 && t > place) part.z += 0.01;
        if (kind == 3 && std::abs(t - place) < 0.004) part.y = std::numeric_limits<double>::quiet_NaN();
        return p;
      };
      const PathCheck check = checkPath(1.4, broken);
      EXPECT_FALSE(check.smooth) << kind;
      EXPECT_NEAR(check.brokenAt, place, 1.4 / 96) << kind;
    }
  const PathCheck atEnd = checkPath(1.4, [](double t) {
    PathPoint p = pointOnCircle(t);
    if (t > 1.4 - 1e-9) p.velocity.x = std::numeric_limits<double>::infinity();
    return p;
  });
  EXPECT_FALSE(atEnd.smooth);
}

}  // namespace
}  // namespace reachlab::predict
