#pragma once
#include <string>

#include "base/error.h"

namespace reachlab {

/// The sentence with which `work` is refused; empty: it was done.
template <class Work>
std::string refusalOf(const Work& work) {
  try {
    work();
    return {};
  } catch (const Error& refusal) {
    return refusal.what();
  }
}

}  // namespace reachlab
