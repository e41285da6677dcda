#include "devices/vendor/force_dimension_api.h"

#include <fmt/format.h>

namespace reachlab::devices::dhd {

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
