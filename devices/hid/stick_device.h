#pragma once
#include <functional>
#include <memory>
#include <string>

#include "devices/hid/hid_port.h"
#include "devices/hid/report_descriptor.h"
#include "devices/hid/stick_force.h"
#include "devices/io/polled_device.h"

namespace reachlab::devices {

/// A force-feedback joystick or wheel: its axes' middle is the world's origin, full deflection is `travel` away. x to the right is the
/// world's x, y towards the user the world's z: planar tasks. Its force is relative; `fullForce` is what was measured at full magnitude.
/// Reports come when something changes, so a report that does not come is no loss. Verified against published protocols, not on a device.
class StickDevice final : public Transport {
 public:
  struct Options {
    double travel = 0.05;   // [m] from the middle to the end
    double fullForce = 0;   // [N] 0: not measured, no force is rendered
    bool reversed = false;  // the device counts forces the other way
  };
  using OpenPort = std::function<std::unique_ptr<HidPort>()>;
  /// Throws FaultError (the descriptor has no axis), ResourceError (`open`, or the force cannot be made ready).
  StickDevice(const Options& options, std::string name, const HidLayout& layout, std::unique_ptr<StickForce> force, OpenPort open);

  haptics::DeviceInfo info() const override;
  Exchange exchange(ForceSource& force, haptics::DeviceSample& sample) override;
  bool tellZero() noexcept override { return !port_ || !(options_.fullForce > 0) || force_->tell(*port_, 0, 0); }
  bool reopen() override;
  void close() noexcept override;

 private:
  void open();
  bool take(std::span<const std::uint8_t> report) noexcept;

  Options options_;
  std::string name_;
  HidLayout layout_;
  const HidField *x_, *y_;
  std::unique_ptr<StickForce> force_;
  OpenPort open_;
  std::unique_ptr<HidPort> port_;
  Vec3 place_;  // [m] world
  std::uint32_t buttons_ = 0;
  int garbled_ = 0;
};

}  // namespace reachlab::devices
