#pragma once
#include <string>

#include "base/error.h"

namespace reachlab {

/// The sentence with which `work` is refused, or `done` where it was not.
template <class Work>
std::string refusalOf(const Work& work, const std::string& done = {}) {
  try {
    work();
    return done;
  } catch (const Error& refusal) {
    return refusal.what();
  }
}

}  // namespace reachlab
