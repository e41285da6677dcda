#pragma once
#include "base/butterworth.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/device.h"

namespace reachlab::haptics {

/// v_HIP from device samples of 1 ms. Encoder quantisation alone makes a plain difference jump by 0.04-0.10 m/s.
///   difference    (r_n - r_n-1)/dt
///   butterworth   the difference through a second-order Butterworth low-pass (bilinear transform with prewarping, |H(f)|^2 =
///                 1/(1 + (f/fc)^4) on the warped axis); delay at low frequencies sqrt(2)/(2 pi fc): 5.6 ms at 40 Hz
///   device        what the device measures itself; the butterworth where it measures nothing
///   auto          device
/// The filter starts at rest; reset() after a jump or a loss. Haptic thread.
class VelocityEstimator {
 public:
  /// Cutoff in (0, 500) Hz; problems(Experiment) reports other values.
  explicit VelocityEstimator(const experiment::VelocityEstimatorSpec& spec);
  void reset() noexcept { count_ = 0; }
  /// Velocity at this sample [m/s], world frame.
  Vec3 estimate(const DeviceSample& sample) noexcept;

 private:
  bool fromDevice_, filtered_;
  Biquad filter_;
  Vec3 last_;
  Vec3 x1_, x2_, y1_, y2_;  // the filter's last inputs and outputs
  int count_ = 0;
};

}  // namespace reachlab::haptics
