#include "sim/haptics/velocity_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "base/math/butterworth.h"
#include "base/ticks.h"

namespace reachlab::haptics {
namespace {

DeviceSample at(double x) { return {.position = {x, 0, 0}}; }

TEST(VelocityEstimator, FollowsASteadyHandExactly) {
  for (const char* kind : {"difference", "low-pass", "butterworth", "kalman", "adaptive-window", "auto"}) {
    VelocityEstimator estimator({kind, 40});
    double v = 0;
    for (int i = 0; i < 500; ++i) v = estimator.estimate(at(0.3 * i * 1e-3)).x;
    EXPECT_NEAR(v, 0.3, 1e-9) << kind << ": rounding of the position, times 1000";
  }
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

TEST(VelocityEstimator, TakesTheDevicesOwnVelocityWhereItIsWanted) {
  const DeviceSample sample{.position = {0.1, 0, 0}, .velocity = {1, 2, 3}, .hasVelocity = true};
  EXPECT_EQ(VelocityEstimator({"auto", 40}).estimate(sample), (Vec3{1, 2, 3}));
  EXPECT_EQ(VelocityEstimator({"device", 40}).estimate(sample), (Vec3{1, 2, 3}));
  EXPECT_EQ(VelocityEstimator({"butterworth", 40}).estimate(sample), Vec3{});
}

// The rows of a hand that steps by (1, -2, 0.5) mm; axes alike.
std::vector<Vec3> afterAStep(VelocityEstimator estimator, int ticks) {
  const Vec3 from{0.3, -0.2, 0.1}, step{1e-3, -2e-3, 0.5e-3};
  std::vector<Vec3> rows;
  for (int i = 0; i < ticks; ++i) {
    rows.push_back(estimator.estimate({.position = i == 0 ? from : from + step}));
    EXPECT_NEAR(rows.back().y, -2 * rows.back().x, 1e-9) << i;
    EXPECT_NEAR(rows.back().z, 0.5 * rows.back().x, 1e-9) << i;
  }
  return rows;
}

TEST(VelocityEstimator, TheDifferenceOfAStepIsOneTickHigh) {
  const auto rows = afterAStep(VelocityEstimator({"difference", 40}), 4);
  EXPECT_NEAR(rows[1].x, 1, 1e-9);
  EXPECT_EQ(rows[0], Vec3{});
  EXPECT_EQ(rows[2], Vec3{});
}

// 1/(s + 1) at w = tan(pi fc dt): b0 of the first difference, then a decay by (1 - w)/(1 + w) a tick.
TEST(VelocityEstimator, TheLowPassForgetsAStepByItsPole) {
  for (const double cutoff : {12.0, 90.0}) {
    const double w = std::tan(std::numbers::pi * cutoff * 1e-3), b = w / (1 + w), pole = (1 - w) / (1 + w);
    const auto rows = afterAStep(VelocityEstimator({"low-pass", cutoff}), 30);
    EXPECT_NEAR(rows[1].x, b, 1e-12);
    for (int i = 2; i < 30; ++i) EXPECT_NEAR(rows[static_cast<std::size_t>(i)].x, b * (1 + pole) * std::pow(pole, i - 2), 1e-12) << i;
  }
}

// The same recursion over the samples that y = b0 x + b1 x' + b2 x'' - a1 y' - a2 y'' names.
TEST(VelocityEstimator, TheButterworthIsItsSectionOfTheDifference) {
  const Biquad section = butterworthLowPass(25, 1e-3);
  const auto rows = afterAStep(VelocityEstimator({"butterworth", 25}), 40), own = afterAStep(VelocityEstimator({"auto", 25}), 40);
  std::array<double, 2> x{}, y{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double difference = i == 1 ? 1 : 0;
    const double out = section.b[0] * difference + section.b[1] * x[0] + section.b[2] * x[1] - section.a[1] * y[0] - section.a[2] * y[1];
    x = {difference, x[0]};
    y = {out, y[0]};
    EXPECT_NEAR(rows[i].x, out, 1e-12) << i;
    EXPECT_EQ(own[i], rows[i]) << "what a device that measures nothing gets";
  }
}

// The Riccati equation solved by another method (structure-preserving doubling, 60 digits): the place's 1 mm, felt as a velocity.
TEST(VelocityEstimator, KalmanHasTheGainsOfItsRiccatiEquation) {
  const std::tuple<double, std::size_t, double> expected[] = {
      {40, 1, 0.09877359186737265},   {40, 2, 0.1605051818405833},     {40, 5, 0.19091102582482666},  {40, 10, 0.0445799275181896},
      {40, 20, -0.03974309596796041}, {40, 40, 0.0007129393942542262}, {15, 1, 0.016179397251934544}, {15, 2, 0.030073177633777592},
      {15, 5, 0.05953744932079956},   {15, 10, 0.07659251360468261},   {15, 20, 0.04676802436171189}, {15, 40, -0.018630095017439875}};
  for (const auto& [cutoff, tick, velocity] : expected)
    EXPECT_NEAR(afterAStep(VelocityEstimator({"kalman", cutoff}), 41)[tick].x, velocity, 1e-9) << cutoff << " Hz, tick " << tick;
}

// Along a t^2/2 a chord of L ticks is off by a dt^2 k (L - k)/2 at its k-th sample, and its slope is the velocity at its middle.
TEST(VelocityEstimator, TheAdaptiveWindowIsAsLongAsItsNoiseAllows) {
  for (const auto& [acceleration, length] : {std::pair{2.0, 15}, {7.9, 7}, {0.4, 32}})
    for (const int axis : {0, 1, 2}) {
      VelocityEstimator estimator({"adaptive-window", 40});
      const auto component = [axis](Vec3& v) -> double& { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
      for (int i = 0; i < 150; ++i) {
        const double t = 1e-3 * i;
        DeviceSample sample;
        component(sample.position) = 0.1 + acceleration * t * t / 2;
        Vec3 velocity = estimator.estimate(sample);
        const int window = std::min(i, length);
        EXPECT_NEAR(component(velocity), acceleration * (t - 1e-3 * window / 2), 1e-9) << acceleration << ", tick " << i;
      }
    }
  EXPECT_EQ(VelocityEstimator::kMaxWindowDuration, 32);
  EXPECT_EQ(VelocityEstimator::kWindowNoise, 60e-6);
}

// A reset while samples stand in every memory: what follows is as from a new estimator, bit for bit.
TEST(VelocityEstimator, AResetForgetsEverything) {
  for (const char* kind : {"difference", "low-pass", "butterworth", "kalman", "adaptive-window", "device"}) {
    VelocityEstimator used({kind, 40}), fresh({kind, 40});
    for (int i = 0; i < 50; ++i) used.estimate(at(1e-5 * i * i));
    used.reset();
    for (int i = 0; i < 50; ++i) ASSERT_EQ(used.estimate(at(0.3 - 2e-5 * i * i)), fresh.estimate(at(0.3 - 2e-5 * i * i))) << kind << i;
  }
}

// A device that measures its velocity now and then: in between, the difference is to the sample before, also of those.
TEST(VelocityEstimator, WhereTheDeviceMeasuresNothingTheFilterGoesOnFromTheSampleBefore) {
  VelocityEstimator device({"device", 30}), filter({"butterworth", 30});
  const DeviceSample second{.position = {0.4, 0, 0}, .velocity = {9, 0, 0}, .hasVelocity = true};
  device.estimate(at(0.1));
  EXPECT_EQ(device.estimate(second), second.velocity);
  filter.estimate(at(0.4));
  EXPECT_NEAR(device.estimate(at(0.401)).x, filter.estimate(at(0.401)).x, 1e-12);
}

/// The delay of the estimate of a hand on a circle, from its phase against the true velocity.
double measuredDelay(const experiment::VelocityEstimatorSpec& spec, double hertz) {
  const double omega = 2 * std::numbers::pi * hertz;
  VelocityEstimator estimator(spec);
  double sine = 0, cosine = 0;
  const int turns = 3, ticks = static_cast<int>(std::lround(turns / (hertz * kTickSeconds)));
  for (int i = 0; i <= 2 * ticks; ++i) {
    const double t = i * kTickSeconds;
    const Vec3 v = estimator.estimate({.position = {0.1 * std::cos(omega * t), 0.1 * std::sin(omega * t), 0}});
    if (i < ticks) continue;  // settles
    const Vec3 along{-std::sin(omega * t), std::cos(omega * t), 0}, inwards{-std::cos(omega * t), -std::sin(omega * t), 0};
    cosine += dot(v, along);
    sine -= dot(v, inwards);
  }
  return std::atan2(sine, cosine) / omega;
}

// Half a per cent of the delay: at 1 Hz the phase of these filters differs from its linear part by (f / fc)^2 and less.
TEST(VelocityDelay, IsThatOfTheEstimateOfASlowCircle) {
  for (const char* kind : {"difference", "low-pass", "butterworth", "auto"})
    for (const double cutoff : {20.0, 40.0}) {
      const experiment::VelocityEstimatorSpec spec{kind, cutoff};
      EXPECT_NEAR(measuredDelay(spec, 1), velocityDelay(spec), 0.005 * velocityDelay(spec)) << kind << " " << cutoff;
    }
}

TEST(VelocityDelay, AKalmanFilterOfASlowCircleHasNone) {
  const experiment::VelocityEstimatorSpec spec{"kalman", 40};
  EXPECT_NEAR(measuredDelay(spec, 1), velocityDelay(spec), 1e-4) << "a tenth of a tick";
}

TEST(VelocityDelay, AnAdaptiveWindowHasAtMostHalfOfItsLongest) {
  const experiment::VelocityEstimatorSpec spec{"adaptive-window", 40};
  EXPECT_GT(measuredDelay(spec, 0.2), 0);
  EXPECT_LE(measuredDelay(spec, 0.2), velocityDelay(spec));
}

}  // namespace
}  // namespace reachlab::haptics
