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

/// Making one throws ResourceError when the library is missing or lacks a function. A function that is only looked for (`find`) may be null.
struct Api {
  SharedLibrary library{{"libHD.so", "libHD.so.3", "libHD.so.3.4", "libHD.so.3.4.0", "libHD.so.3.0", "libHD.so.3.0.0"}};
  Handle (*initDevice)(const char* name) = library.require("hdInitDevice");
  void (*disableDevice)(Handle) = library.require("hdDisableDevice");
  void (*makeCurrentDevice)(Handle) = library.require("hdMakeCurrentDevice");
  void (*beginFrame)(Handle) = library.require("hdBeginFrame");
  void (*endFrame)(Handle) = library.require("hdEndFrame");
  ErrorInfo (*getError)() = library.require("hdGetError");
  const char* (*getErrorString)(std::uint32_t) = library.require("hdGetErrorString");
  void (*enable)(Enum) = library.require("hdEnable");
  void (*disable)(Enum) = library.require("hdDisable");
  void (*getDoublev)(Enum, double*) = library.require("hdGetDoublev");
  void (*getIntegerv)(Enum, std::int32_t*) = library.require("hdGetIntegerv");
  void (*getBooleanv)(Enum, std::uint8_t*) = library.find("hdGetBooleanv");
  const char* (*getString)(Enum) = library.find("hdGetString");
  void (*setDoublev)(Enum, const double*) = library.require("hdSetDoublev");
  Enum (*checkCalibration)() = library.find("hdCheckCalibration");
  Enum (*checkCalibrationStyle)() = library.find("hdCheckCalibrationStyle");
  void (*updateCalibration)(Enum) = library.find("hdUpdateCalibration");
  void (*startScheduler)() = library.require("hdStartScheduler");
  void (*stopScheduler)() = library.require("hdStopScheduler");
  void (*setSchedulerRate)(unsigned long) = library.find("hdSetSchedulerRate");
  unsigned long (*scheduleAsynchronous)(Callback*, void*, std::uint16_t) = library.require("hdScheduleAsynchronous");
  void (*unschedule)(unsigned long) = library.require("hdUnschedule");

  /// The newest error as text, "no valid license (0x0600)". Empty when there is no error. Takes every waiting error. `newest`, if given,
  /// becomes the code of the newest error.
  std::string takeErrors(std::uint32_t* newest = nullptr) const;
};

/// Loaded once per program. Throws ResourceError as long as loading fails.
const Api& api();

}  // namespace reachlab::devices::hd
