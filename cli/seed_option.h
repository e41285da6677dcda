#pragma once
#include <CLI/CLI.hpp>

#include "sim/session/session.h"

namespace reachlab::cli {

inline CLI::Validator wholeSeed() {
  return {[](std::string& text) { return session::seedFault(text); }, "SEED"};
}

}  // namespace reachlab::cli
