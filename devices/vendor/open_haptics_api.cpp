#include "devices/vendor/open_haptics_api.h"

#include <fmt/format.h>

#include <string_view>

namespace reachlab::devices::hd {

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
