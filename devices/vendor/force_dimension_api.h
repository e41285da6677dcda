#pragma once
#include <cstdint>
#include <string>

#include "devices/vendor/shared_library.h"

/// The part of Force Dimension's DHD interface that this program uses. It is declared from public sources, so that no SDK is needed to
/// build. Units of the vendor: m, m/s, N, rad. Axes: x towards the user, y right, z up. Every call takes the device's index as a plain
/// `char`. Verified against the published interface, not on a device.
namespace reachlab::devices::dhd {

/// Errors of dhdErrorGetLast after which the device is gone. Other errors may pass.
enum Error : int { kNone = 0, kComm = 2, kNoDevice = 5, kNotAvailable = 6 };
inline constexpr int kTimeGuard = 1;  // the return value of a call that is no error
/// The unit of dhdSetWatchdog. Its `unsigned char` reaches to 31 ms.
inline constexpr std::int64_t kWatchdogUnitNs = 125'000;

/// Making one throws ResourceError when the library is missing or lacks a function. A function that is only looked for (`find`) may be null.
struct Api {
  SharedLibrary library{{"libdrd.so.3", "libdrd.so", "libdhd.so.3", "libdhd.so"}};
  int (*getDeviceCount)() = library.require("dhdGetDeviceCount");
  int (*openId)(char) = library.require("dhdOpenID");
  int (*close)(char) = library.require("dhdClose");
  int (*stop)(char) = library.find("dhdStop");
  int (*enableForce)(unsigned char, char) = library.require("dhdEnableForce");
  int (*getPosition)(double*, double*, double*, char) = library.require("dhdGetPosition");
  int (*setForce)(double, double, double, char) = library.require("dhdSetForce");
  int (*errorGetLast)() = library.find("dhdErrorGetLast");
  const char* (*errorGetLastStr)() = library.find("dhdErrorGetLastStr");
  int (*getSystemType)(char) = library.find("dhdGetSystemType");
  const char* (*getSystemName)(char) = library.find("dhdGetSystemName");
  int (*getSerialNumber)(std::uint16_t*, char) = library.find("dhdGetSerialNumber");
  int (*getLinearVelocity)(double*, double*, double*, char) = library.find("dhdGetLinearVelocity");
  std::uint32_t (*getButtonMask)(char) = library.find("dhdGetButtonMask");
  double (*getMaxForce)(char) = library.find("dhdGetMaxForce");
  int (*enableExpertMode)() = library.find("dhdEnableExpertMode");
  int (*setWatchdog)(unsigned char, char) = library.find("dhdSetWatchdog");

  std::string lastError() const;
};

/// Loaded once per program. Throws ResourceError as long as loading fails.
const Api& api();

}  // namespace reachlab::devices::dhd
