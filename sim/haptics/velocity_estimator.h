#pragma once
#include <array>

#include "base/math/butterworth.h"
#include "sim/experiment/velocity_estimator_spec.h"
#include "sim/haptics/device.h"

namespace reachlab::haptics {

/// v_HIP from device samples of 1 ms. Encoder quantisation alone makes a plain difference jump by 0.04-0.10 m/s.
///   difference       (r_n - r_n-1)/dt
///   low-pass         the difference through a first-order low-pass (bilinear, prewarped); delay at low frequencies 1/(2 pi fc)
///   butterworth      the difference through a second-order Butterworth low-pass (bilinear transform with prewarping, |H(f)|^2 =
///                    1/(1 + (f/fc)^4) on the warped axis); delay at low frequencies sqrt(2)/(2 pi fc): 5.6 ms at 40 Hz. It is also what a
///                    steady Kalman filter of a constant velocity driven by white acceleration comes to as dt -> 0
///   kalman           steady Kalman filter of a constant acceleration driven by white jerk, q/r = (2 pi fc)^6; no delay at low frequencies
///   adaptive-window  first-order adaptive windowing (Janabi-Sharifi, Hayward, Chen 2000, "end-fit"): the slope over the longest window,
///                    up to kMaxWindowDuration, whose every sample lies within kWindowNoise of the line through its ends; delay half of it
///   device           what the device measures itself; the butterworth where it measures nothing
///   auto             device (docs/devices.md has the table that it was chosen by)
/// Axes alike, but the window is one for all three. Starts at rest. Call reset() after a jump or a loss. Haptic thread.
class VelocityEstimator {
 public:
  static constexpr int kMaxWindowDuration = 32;    // [ticks]
  static constexpr double kWindowNoise = 0.06e-3;  // [m] half a step of the coarsest encoders of docs/devices.md, and a little

  /// Cutoff in (0, 500) Hz. check(Experiment) reports other values.
  explicit VelocityEstimator(const experiment::VelocityEstimatorSpec& spec);
  void reset() noexcept { count_ = 0; }
  /// Velocity at this sample [m/s], world frame.
  Vec3 estimate(const DeviceSample& sample) noexcept;

 private:
  enum class Kind : std::uint8_t { Difference, Recursive, Kalman, Window };
  Vec3 filter(const Vec3& difference) noexcept;
  Vec3 correct(const Vec3& measured) noexcept;
  Vec3 slope() const noexcept;
  void designKalman(double cutoff);

  Kind kind_;
  bool fromDevice_;
  Biquad filter_;
  std::array<double, 2> shape_{};  // b1/b0, b2/b0: 2 and 1 to the bit for the Butterworth
  Vec3 last_;
  Vec3 x1_, x2_, y1_, y2_;             // the filter's last inputs and outputs
  std::array<double, 3> gain_{};       // Kalman: of place, speed, acceleration
  Vec3 place_, speed_, acceleration_;  // Kalman: the state
  std::array<Vec3, kMaxWindowDuration + 1> window_{};
  int count_ = 0;  // samples since the last reset, counts on modulo the window
};

/// The delay [s] of the estimate of a slow movement, as the filters state it, with the half tick of a difference. `auto` counts as butterworth,
/// its value for a device that measures no velocity. The adaptive window counts with half of its longest length. Any thread.
double velocityDelay(const experiment::VelocityEstimatorSpec& spec);

}  // namespace reachlab::haptics
