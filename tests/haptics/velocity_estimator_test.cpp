#include "sim/haptics/velocity_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace reachlab::haptics {
namespace {

DeviceSample at(double x) {
  DeviceSample sample;
  sample.position = {x, 0, 0};
  return sample;
}

// Amplitude of the estimate for a hand that swings with 1 m/s at this frequency, after the start has died away.
double gainAt(VelocityEstimator& estimator, double frequency) {
  const double w = 2 * std::numbers::pi * frequency;
  double most = 0;
  for (int i = 0; i < 4000; ++i) {
    const double v = estimator.estimate(at(std::sin(w * i * 1e-3) / w)).x;
    if (i > 1000) most = std::max(most, std::abs(v));
  }
  return most;
}

TEST(VelocityEstimator, FollowsASteadyHandExactly) {
  for (const char* kind : {"difference", "low-pass", "butterworth", "kalman", "adaptive-window", "auto"}) {
    VelocityEstimator estimator({kind, 40});
    double v = 0;
    for (int i = 0; i < 500; ++i) v = estimator.estimate(at(0.3 * i * 1e-3)).x;
    EXPECT_NEAR(v, 0.3, 1e-9) << kind << ": rounding of the position, times 1000";
  }
}

TEST(VelocityEstimator, StartsAtRest) {
  VelocityEstimator estimator({"butterworth", 40});
  EXPECT_EQ(estimator.estimate(at(0.5)), Vec3{});
  estimator.estimate(at(0.6));
  estimator.reset();
  EXPECT_EQ(estimator.estimate(at(-0.5)), Vec3{});
}

TEST(VelocityEstimator, ButterworthIsThreeDecibelsDownAtItsCutoff) {
  VelocityEstimator estimator({"butterworth", 40});
  // The plain difference has a gain of its own, sin(x)/x with x = pi f dt, at 40 Hz 0.26 % below one.
  const double x = std::numbers::pi * 40 * 1e-3;
  constexpr double kPeakMissed = 0.01;  // samples need not fall on the crest
  EXPECT_NEAR(gainAt(estimator, 40), std::sin(x) / x / std::numbers::sqrt2, kPeakMissed);
}

// One count of an encoder, 60 um, is 0.06 m/s to the difference; the tolerance of a trial is 0.006 m/s.
TEST(VelocityEstimator, ButterworthTamesQuantisation) {
  VelocityEstimator rough({"difference", 40}), smooth({"butterworth", 40});
  double roughWorst = 0, smoothWorst = 0;
  for (int i = 0; i < 3000; ++i) {
    const double true_ = 0.01 * i * 1e-3, seen = 60e-6 * std::round(true_ / 60e-6);
    const double r = std::abs(rough.estimate(at(seen)).x - 0.01), s = std::abs(smooth.estimate(at(seen)).x - 0.01);
    if (i > 200) roughWorst = std::max(roughWorst, r), smoothWorst = std::max(smoothWorst, s);
  }
  EXPECT_LT(smoothWorst, 0.25 * roughWorst);
}

// A hand that speeds up evenly: the low-passes lag by their delay times the acceleration, a filter that knows of accelerations does not.
TEST(VelocityEstimator, KalmanFollowsAnAccelerationWithoutLag) {
  VelocityEstimator kalman({"kalman", 40}), butterworth({"butterworth", 40});
  double ahead = 0, behind = 0;
  for (int i = 0; i < 1000; ++i) {
    const double t = i * 1e-3;
    ahead = kalman.estimate(at(t * t)).x - 2 * t;
    behind = butterworth.estimate(at(t * t)).x - 2 * t;
  }
  EXPECT_NEAR(ahead, 0, 1e-6);
  EXPECT_NEAR(behind, -2 * (0.5e-3 + std::numbers::sqrt2 / (2 * std::numbers::pi * 40)), 1e-4);
}

// Within the window's noise bound a slow hand's steps are not seen at all; a fast hand gets a short window.
TEST(VelocityEstimator, AdaptiveWindowIsLongWhereTheHandIsStraight) {
  VelocityEstimator estimator({"adaptive-window", 40});
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const double seen = 60e-6 * std::round(0.02 * i * 1e-3 / 60e-6);
    const double v = estimator.estimate(at(seen)).x;
    if (i > 200) worst = std::max(worst, std::abs(v - 0.02));
  }
  EXPECT_LT(worst, 0.01) << "a plain difference is 0.04 to 0.06 off";
  estimator.reset();
  for (int i = 0; i < 100; ++i) estimator.estimate(at(0));
  double v = 0;
  for (int i = 1; i <= 5; ++i) v = estimator.estimate(at(1e-3 * i)).x;
  EXPECT_NEAR(v, 1, 0.05) << "after five ticks at 1 m/s";
}

TEST(VelocityEstimator, TakesTheDevicesOwnVelocityWhereItIsWanted) {
  DeviceSample sample = at(0.1);
  sample.velocity = {1, 2, 3};
  sample.hasVelocity = true;
  EXPECT_EQ(VelocityEstimator({"auto", 40}).estimate(sample), (Vec3{1, 2, 3}));
  EXPECT_EQ(VelocityEstimator({"device", 40}).estimate(sample), (Vec3{1, 2, 3}));
  EXPECT_EQ(VelocityEstimator({"butterworth", 40}).estimate(sample), Vec3{});
}

}  // namespace
}  // namespace reachlab::haptics
