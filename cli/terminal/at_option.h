#pragma once
#include <string>
#include <utility>

#include "base/error.h"

namespace reachlab::cli {

/// Calls a function that writes to the file of an option. A fault of the disk then begins with the option's name, so that it is clear which
/// option to change.
template <class Action>
auto atOption(const std::string& option, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (const ResourceError& fault) {
    throw ResourceError(option + ": " + fault.what());
  }
}

}  // namespace reachlab::cli
