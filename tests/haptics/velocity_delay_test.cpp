#include "sim/haptics/velocity_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/ticks.h"

namespace reachlab::haptics {
namespace {

/// The delay of the estimate of a hand on a circle, from its phase against the true velocity.
double measuredDelay(const experiment::VelocityEstimatorSpec& spec, double hertz) {
  const double omega = 2 * std::numbers::pi * hertz;
  VelocityEstimator estimator(spec);
  double sine = 0, cosine = 0;
  const int turns = 3, ticks = static_cast<int>(std::lround(turns / (hertz * kTickSeconds)));
  for (int i = 0; i <= 2 * ticks; ++i) {
    const double t = i * kTickSeconds;
    DeviceSample sample;
    sample.position = {0.1 * std::cos(omega * t), 0.1 * std::sin(omega * t), 0};
    const Vec3 v = estimator.estimate(sample);
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
