#include "devices/mouse/mouse_device.h"

#include <cmath>

#include "base/error.h"
#include "base/ticks.h"
#include "devices/drivers.h"

namespace reachlab::devices {

haptics::DeviceInfo MouseDevice::info() const {
  haptics::DeviceInfo info;
  info.name = "mouse";
  info.version = "1";
  return info;
}

haptics::DeviceSample MouseDevice::read() noexcept {
  if (const Vec3* target = targets_.takeLatest()) target_ = *target;
  // Exact solution of the critically damped system over one tick, with the target held.
  constexpr double w = 1 / kSmoothing;
  const double decay = std::exp(-w * kTickSeconds);
  const Vec3 away = position_ - target_, slope = velocity_ + w * away;
  position_ = target_ + decay * (away + kTickSeconds * slope);
  velocity_ = decay * (velocity_ - w * kTickSeconds * slope);
  haptics::DeviceSample sample;
  sample.position = position_;
  sample.velocity = velocity_;
  sample.hasVelocity = true;
  return sample;
}

void MouseDevice::write(const Vec3&) noexcept {}

DeviceDriver mouseDriver() {
  return {"mouse",
          "mouse",
          "the pointer in the window of `reachlab`",
          true,
          [](const DeviceDriver& self) {
            std::vector<FoundDevice> rows = alwaysThere(self);
            rows.front().rate = 125;
            return rows;
          },
          [](const DeviceRequest&) -> std::unique_ptr<haptics::HapticDevice> {
            throw ResourceError("device mouse: needs a window to point into; use `reachlab`");
          }};
}

}  // namespace reachlab::devices
