#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "devices/hid/hid_port.h"
#include "devices/hid/report_descriptor.h"

namespace reachlab::devices {

/// How a stick or wheel is told its force: x to the right, y towards the user, as shares of its full force (-1 … 1). I/O thread.
class StickForce {
 public:
  virtual ~StickForce() = default;
  /// Makes it ready, with no force. Empty: done; else why not.
  virtual std::string start(HidPort& port) = 0;
  /// False: it is gone.
  virtual bool tell(HidPort& port, double x, double y) noexcept = 0;
  virtual void stop(HidPort& port) noexcept = 0;
  virtual int axes() const = 0;
};

/// USB HID PID 1.0 by the report descriptor: one constant-force effect for each axis, made and started once, its magnitude set anew with
/// each force. Throws FaultError naming the report that the descriptor lacks.
std::unique_ptr<StickForce> makePidForce(const HidLayout& layout);
/// Logitech G940: 63 bytes, 0x51 at 0, -x at 1, -y at 31 (the kernel's hid-lg3ff). Its hand sensor must be covered.
std::unique_ptr<StickForce> makeG940Force();
/// Logitech G25, G27, G29, DFGT, …: `11 08 F 80 00 00 00`, F = 0x80 + force (the kernel's hid-lg4ff).
std::unique_ptr<StickForce> makeWheelForce();

}  // namespace reachlab::devices
