#pragma once
#include <array>
#include <memory>

#include "devices/virtual/device_model.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// A hand that holds the device, as a passive impedance about its intended position.
struct HandImpedance {
  double mass = 1.0;       // [kg] that moves with the handle
  double stiffness = 300;  // [N/m]
  double damping = 10;     // [N s/m]
};

/// A device that is simulated as a body. The tick's force acts on apparent mass, friction and the hand that holds it. The position comes
/// back quantised. So the whole loop is closed without hardware.
///
///   (m + m_h) x'' = F + k (p - x) + b (p' - x') + (m + m_h) p'' - b_d x' - c tanh(x'/v0)
///
/// p is the intended position of the hand (any hand that moves by tick count). The inertia of the hand is fed forward, so that the hand
/// reaches p without a force. Each axis is alike. Semi-implicit Euler at 0.1 ms. A force is limited to the model's peak and acts
/// `delayTicks` later than the tick that wrote it. Each `read` advances by one tick.
class VirtualDevice final : public haptics::HapticDevice {
 public:
  static constexpr int kMostDelay = 32;
  struct Options {
    HandImpedance hand;
    int delayTicks = 0;  // 0 … kMostDelay - 1
    bool quantised = true;
  };
  VirtualDevice(const DeviceModel& model, const Options& options, std::unique_ptr<haptics::HapticDevice> hand);

  haptics::DeviceInfo info() const override;
  void prepareTrial(int index, int scene = 0) override { hand_->prepareTrial(index, scene); }
  void cue(haptics::Cue cue) noexcept override;
  haptics::DeviceSample read() noexcept override;
  void write(const Vec3& force) noexcept override;
  void see(std::span<const dynamics::MassState> masses) noexcept override { hand_->see(masses); }

 private:
  void advanceTick(const Vec3& from, const Vec3& to) noexcept;

  DeviceModel model_;
  Options options_;
  std::unique_ptr<haptics::HapticDevice> hand_;
  Vec3 place_, speed_;       // [m], [m/s] of the handle
  Vec3 meant_, meantSpeed_;  // intended position and speed at the tick before
  bool placed_ = false;
  std::array<Vec3, kMostDelay> forces_{};  // [N] by tick, newest at `at_`
  int at_ = 0;
  std::uint64_t reports_ = 0;
};

}  // namespace reachlab::devices
