#include "devices/vendor/force_dimension_api.h"

#include <fmt/format.h>

namespace reachlab::devices::dhd {

Api::Api() : library({"libdrd.so.3", "libdrd.so", "libdhd.so.3", "libdhd.so"}) {
  library.bind(getDeviceCount, "dhdGetDeviceCount");
  library.bind(openId, "dhdOpenID");
  library.bind(close, "dhdClose");
  library.bind(enableForce, "dhdEnableForce");
  library.bind(getPosition, "dhdGetPosition");
  library.bind(setForce, "dhdSetForce");
  library.bindIfThere(stop, "dhdStop");
  library.bindIfThere(errorGetLast, "dhdErrorGetLast");
  library.bindIfThere(errorGetLastStr, "dhdErrorGetLastStr");
  library.bindIfThere(getSystemType, "dhdGetSystemType");
  library.bindIfThere(getSystemName, "dhdGetSystemName");
  library.bindIfThere(getSerialNumber, "dhdGetSerialNumber");
  library.bindIfThere(getLinearVelocity, "dhdGetLinearVelocity");
  library.bindIfThere(getOrientationFrame, "dhdGetOrientationFrame");
  library.bindIfThere(getButtonMask, "dhdGetButtonMask");
  library.bindIfThere(hasWrist, "dhdHasWrist");
  library.bindIfThere(getMaxForce, "dhdGetMaxForce");
  library.bindIfThere(enableExpertMode, "dhdEnableExpertMode");
  library.bindIfThere(setWatchdog, "dhdSetWatchdog");
}

std::string Api::lastError() const {
  const int code = errorGetLast != nullptr ? errorGetLast() : -1;
  const char* words = errorGetLastStr != nullptr ? errorGetLastStr() : nullptr;
  return fmt::format("{} (DHD error {})", words != nullptr && *words != 0 ? words : "no words given", code);
}

const Api& api() {
  static const Api loaded;  // tried again on the next call when it throws
  return loaded;
}

}  // namespace reachlab::devices::dhd
