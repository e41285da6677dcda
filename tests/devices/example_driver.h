#pragma once
#include <cmath>

#include "devices/driver/registry.h"
#include "devices/io/polled_device.h"

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

// Its calls may wait, so they are made by the I/O thread of PolledDevice.
class SpringHandle final : public Transport {
 public:
  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info;
    info.name = "Spring Handle";
    info.maxForce = 4;  // [N]; better asked of the device. These three are left out where it renders no force
    info.maxContinuousForce = 1;
    info.rendersForce = true;  // the watch and the watchdog look after it from here on
    info.rate = 1000;          // [1/s] of its reports; they may come more slowly than the tick
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
  std::string lossText() const override { return "its cable is out"; }  // `device Spring Handle is lost: …`
  void close() noexcept override { vendorWrite(0, 0, 0); }
};

// One line in registry.cpp makes it known to `reach list devices`, to `--device`, and to the window.
inline DeviceDriver springHandleDriver() {
  return {
      .name = "springhandle",
      .usage = "springhandle",
      .description = "Spring Handle of this page",
      .find = [](const DeviceDriver& self) -> std::vector<FoundDevice> {
        if (vendorUnplugged) return {absentDevice(self, "no Spring Handle is connected")};
        return {presentDevice(self, {}, SpringHandle().info())};
      },
      // What stands behind the name, springhandle:PATH,gain=2, is request.argument; DeviceOptions (base/device_options.h) takes it apart. What is
      // wrong there throws FaultError (base/fault.h), what cannot be had ResourceError (base/error.h).
      .make = [](const DeviceRequest&) -> std::unique_ptr<haptics::HapticDevice> {
        return std::make_unique<PolledDevice>(std::make_shared<SpringHandle>());  // refused if no report comes within 2 s
      }};
}

}  // namespace reachlab::devices::example
