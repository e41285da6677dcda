#include "devices/vendor/open_haptics_api.h"

#include <fmt/format.h>

#include <string_view>

namespace reachlab::devices::hd {

Api::Api() : library({"libHD.so", "libHD.so.3", "libHD.so.3.4", "libHD.so.3.4.0", "libHD.so.3.0", "libHD.so.3.0.0"}) {
  library.bind(initDevice, "hdInitDevice");
  library.bind(disableDevice, "hdDisableDevice");
  library.bind(makeCurrentDevice, "hdMakeCurrentDevice");
  library.bind(beginFrame, "hdBeginFrame");
  library.bind(endFrame, "hdEndFrame");
  library.bind(getError, "hdGetError");
  library.bind(getErrorString, "hdGetErrorString");
  library.bind(enable, "hdEnable");
  library.bind(disable, "hdDisable");
  library.bind(getDoublev, "hdGetDoublev");
  library.bind(getIntegerv, "hdGetIntegerv");
  library.bindIfThere(getBooleanv, "hdGetBooleanv");
  library.bindIfThere(getString, "hdGetString");
  library.bind(setDoublev, "hdSetDoublev");
  library.bindIfThere(checkCalibration, "hdCheckCalibration");
  library.bindIfThere(checkCalibrationStyle, "hdCheckCalibrationStyle");
  library.bindIfThere(updateCalibration, "hdUpdateCalibration");
  library.bind(startScheduler, "hdStartScheduler");
  library.bind(stopScheduler, "hdStopScheduler");
  library.bindIfThere(setSchedulerRate, "hdSetSchedulerRate");
  library.bind(scheduleAsynchronous, "hdScheduleAsynchronous");
  library.bind(unschedule, "hdUnschedule");
}

namespace {

// What helps, where the library's own words do not say it.
std::string_view hintOf(std::uint32_t code) {
  switch (code) {
    case kDeviceFault:
    case kCommunication:
    case kCommunicationConfig: return "; is it connected, switched on, and set up under that name in the vendor's own tool?";
    case kAlreadyInitiated: return "; another program has it: end that one";
    case kInvalidLicence: return "; the vendor's licence manager renews it";
    default: return "";
  }
}

}  // namespace

std::string Api::takeErrors(std::uint32_t* newest) const {
  constexpr int kMost = 100;  // a library that never stops telling is left
  std::string words;
  for (int i = 0; i < kMost; ++i) {
    const ErrorInfo error = getError();
    if (error.code == kSuccess) break;
    if (!words.empty()) continue;
    const char* said = getErrorString(error.code);
    words = fmt::format("{} (0x{:04X}){}", said != nullptr && *said != 0 ? said : "no words given", error.code, hintOf(error.code));
    if (newest != nullptr) *newest = error.code;
  }
  return words;
}

const Api& api() {
  static const Api loaded;  // tried again on the next call when it throws
  return loaded;
}

}  // namespace reachlab::devices::hd
