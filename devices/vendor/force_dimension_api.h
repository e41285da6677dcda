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

struct Api {
  /// Throws ResourceError when the library is missing or lacks a function.
  Api();
  SharedLibrary library;
  int (*getDeviceCount)() = nullptr;
  int (*openId)(char) = nullptr;
  int (*close)(char) = nullptr;
  int (*stop)(char) = nullptr;
  int (*enableForce)(unsigned char, char) = nullptr;
  int (*getPosition)(double*, double*, double*, char) = nullptr;
  int (*setForce)(double, double, double, char) = nullptr;
  int (*errorGetLast)() = nullptr;  // these may all be null
  const char* (*errorGetLastStr)() = nullptr;
  int (*getSystemType)(char) = nullptr;
  const char* (*getSystemName)(char) = nullptr;
  int (*getSerialNumber)(std::uint16_t*, char) = nullptr;
  int (*getLinearVelocity)(double*, double*, double*, char) = nullptr;
  int (*getOrientationFrame)(double[3][3], char) = nullptr;
  std::uint32_t (*getButtonMask)(char) = nullptr;
  bool (*hasWrist)(char) = nullptr;
  double (*getMaxForce)(char) = nullptr;
  int (*enableExpertMode)() = nullptr;
  int (*setWatchdog)(unsigned char, char) = nullptr;

  std::string lastError() const;
};

/// Loaded once per program. Throws ResourceError as long as loading fails.
const Api& api();

}  // namespace reachlab::devices::dhd
