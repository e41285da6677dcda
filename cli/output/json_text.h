#pragma once
#include <string>

namespace reachlab::cli {

/// The text of a JSON value for standard output, with a line end. Bytes that are no UTF-8, which the name of a file may have, become U+FFFD.
template <class Json>
std::string jsonText(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace reachlab::cli
