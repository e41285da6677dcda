#pragma once
#include <string>
#include <utility>

#include "base/error.h"

namespace reachlab::cli {

/// Does what writes to the place that an option gave; a fault of the disk then begins with the option, so that it is clear which to change.
template <class Action>
auto atOption(const std::string& option, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (const ResourceError& fault) {
    throw ResourceError(option + ": " + fault.what());
  }
}

}  // namespace reachlab::cli
