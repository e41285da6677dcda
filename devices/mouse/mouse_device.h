#pragma once
#include "sim/haptics/device.h"
#include "base/triple_buffer.h"

namespace reachlab::devices {

/// The pointer as a hand. The window sets a target (pixels come at 60-125 Hz, in steps); the hand follows it smoothly as a critically
/// damped second-order system with time constant kSmoothing: x'' = (target - x)/T^2 - 2 x'/T, solved exactly over a tick. Renders no force.
class MouseDevice final : public haptics::HapticDevice {
 public:
  static constexpr double kSmoothing = 0.015;  // [s]

  explicit MouseDevice(const Vec3& at) : position_(at), target_(at) {}
  /// Window's thread, wait-free: where the pointer is [m], world frame. Not finite: ignored.
  void setTarget(const Vec3& target) noexcept {
    if (isFinite(target)) targets_.publish(target);
  }

  haptics::DeviceInfo info() const override;
  haptics::DeviceSample read() noexcept override;
  void write(const Vec3& force) noexcept override;

 private:
  TripleBuffer<Vec3> targets_;
  Vec3 position_, velocity_, target_;
};

}  // namespace reachlab::devices
