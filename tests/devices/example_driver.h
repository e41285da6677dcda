#pragma once
#include <cmath>

#include "devices/io/polled_device.h"
#include "devices/registry.h"

/// A driver, whole: a handle on a spring that a vendor's calls read and drive, here played by two functions.
namespace reachlab::devices::example {

// The vendor's side. Its axes: x away from the user, y right, z up; millimetres and newtons.
inline double vendorForce[3];
inline bool vendorUnplugged = false;
inline bool vendorRead(double mm[3]) {
  mm[0] = 10, mm[1] = 20, mm[2] = 30;
  return !vendorUnplugged;
}
inline bool vendorWrite(double fx, double fy, double fz) {
  vendorForce[0] = fx, vendorForce[1] = fy, vendorForce[2] = fz;
  return !vendorUnplugged;
}

// Its calls may wait, so they are made by the I/O thread of PolledDevice. A serial line, or anything else that looks like a terminal, is opened
// and read line by line by `openSerial` (devices/serial/serial_port.h); what came in part, or not in time, is Exchange::Nothing.
class SpringHandle final : public Transport {
 public:
  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info;
    info.name = "Spring Handle";
    info.maxForce = 4;  // [N]; better asked of the device. These three are left out where it renders no force
    info.maxContinuousForce = 1;
    info.rendersForce = true;  // the watch and the watchdog look after it from here on
    return info;
  }
  // World: x to the right, y up, z towards the user; metres. The same rotation takes the force the other way.
  Exchange exchange(ForceSource& force, haptics::DeviceSample& sample) override {
    double mm[3];
    if (!vendorRead(mm)) return Exchange::Lost;
    sample.position = 1e-3 * Vec3{mm[1], mm[2], -mm[0]};
    const Vec3 f = force.newest();
    return vendorWrite(-f.z, f.x, f.y) ? Exchange::Report : Exchange::Lost;
  }
  bool reopen() override { return !vendorUnplugged; }
  void close() noexcept override { vendorWrite(0, 0, 0); }
};

// One line in registry.cpp makes it known to `reach list devices`, to `--device`, and to the window.
// What stands behind the name, as in springhandle:PATH,gain=2, is the request's argument; DeviceOptions (devices/options.h) takes it apart. What
// is wrong there throws FaultError (base/fault.h), what cannot be had ResourceError.
inline DeviceDriver springHandleDriver() {
  return {"springhandle",
          "springhandle",
          "Spring Handle of this page",
          false,
          [](const DeviceDriver& self) -> std::vector<FoundDevice> {
            if (vendorUnplugged) return {absentDevice(self, "no Spring Handle is connected")};
            return {presentDevice(self, self.name, SpringHandle().info())};
          },
          // What stands behind the name, springhandle:PATH,gain=2, is request.argument; DeviceOptions (devices/options.h) takes it apart. What is
          // wrong there throws FaultError (base/fault.h), what cannot be had ResourceError.
          [](const DeviceRequest&) -> std::unique_ptr<haptics::HapticDevice> {
            return std::make_unique<PolledDevice>(std::make_shared<SpringHandle>());
          }};
}

}  // namespace reachlab::devices::example
