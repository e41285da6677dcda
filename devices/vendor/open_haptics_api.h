#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "devices/vendor/shared_library.h"

/// The part of the OpenHaptics HD interface that this program uses. It is declared from public sources, so that no SDK is needed to build.
/// Units of the vendor: mm, mm/s, N, rad. Axes: x right, y up, z towards the user. Verified against the published interface, not on a
/// device.
namespace reachlab::devices::hd {

using Handle = std::uint32_t;
using Enum = std::uint32_t;
inline constexpr Handle kNoHandle = 0xFFFFFFFF;

/// Returned by value: 12 bytes.
struct ErrorInfo {
  std::uint32_t code = 0;
  std::int32_t internal = 0;
  Handle device = 0;
};
static_assert(sizeof(ErrorInfo) == 12);

enum : Enum {
  kButtons = 0x2000,
  kSafetySwitch = 0x2001,
  kPosition = 0x2050,
  kVelocity = 0x2051,
  kTransform = 0x2052,
  kModel = 0x2501,
  kSerial = 0x2504,
  kUsableWorkspace = 0x2551,
  kMaxForce = 0x2603,
  kMaxContinuousForce = 0x2604,
  kForce = 0x2700,
  kForceOutput = 0x4000,
  kMaxForceClamping = 0x4001,
  kForceRamping = 0x4002,
  kCalibrationNeedsUpdate = 0x5001,
  kCalibrationNeedsInput = 0x5002,
};
enum : std::uint32_t {
  kSuccess = 0,
  kFirstArgumentError = 0x0100,
  kLastArgumentError = 0x0104,
  kWarmMotors = 0x0200,
  kDeviceFault = 0x0300,
  kAlreadyInitiated = 0x0301,
  kCommunication = 0x0302,
  kCommunicationConfig = 0x0303,
  kTimer = 0x0304,
  kInvalidLicence = 0x0600,
};
enum : Enum { kEncoderReset = 1, kAutomatic = 2, kInkwell = 4 };  // styles of calibration
enum : std::uint32_t { kCallbackDone = 0, kCallbackContinue = 1 };
inline constexpr std::uint16_t kHighestPriority = 65535;

using Callback = std::uint32_t(void*);

struct Api {
  /// Throws ResourceError when the library is missing or lacks a function.
  Api();
  SharedLibrary library;
  Handle (*initDevice)(const char* name) = nullptr;
  void (*disableDevice)(Handle) = nullptr;
  void (*makeCurrentDevice)(Handle) = nullptr;
  void (*beginFrame)(Handle) = nullptr;
  void (*endFrame)(Handle) = nullptr;
  ErrorInfo (*getError)() = nullptr;
  const char* (*getErrorString)(std::uint32_t) = nullptr;
  void (*enable)(Enum) = nullptr;
  void (*disable)(Enum) = nullptr;
  void (*getDoublev)(Enum, double*) = nullptr;
  void (*getIntegerv)(Enum, std::int32_t*) = nullptr;
  void (*getBooleanv)(Enum, std::uint8_t*) = nullptr;  // may be null
  const char* (*getString)(Enum) = nullptr;            // may be null
  void (*setDoublev)(Enum, const double*) = nullptr;
  Enum (*checkCalibration)() = nullptr;  // these three may be null
  Enum (*checkCalibrationStyle)() = nullptr;
  void (*updateCalibration)(Enum) = nullptr;
  void (*startScheduler)() = nullptr;
  void (*stopScheduler)() = nullptr;
  void (*setSchedulerRate)(unsigned long) = nullptr;  // may be null
  unsigned long (*scheduleAsynchronous)(Callback*, void*, std::uint16_t) = nullptr;
  void (*unschedule)(unsigned long) = nullptr;

  /// The newest error as text, "no valid license (0x0600)". Empty when there is no error. Takes every waiting error. `newest`, if given,
  /// becomes the code of the newest error.
  std::string takeErrors(std::uint32_t* newest = nullptr) const;
};

/// Loaded once per program. Throws ResourceError as long as loading fails.
const Api& api();

}  // namespace reachlab::devices::hd
