#pragma once
#include <CLI/CLI.hpp>

#include "base/fault.h"
#include "sim/session/session.h"

namespace reachlab::cli {

inline CLI::Validator wholeSeed() {
  return {[](std::string& text) {
            const auto fault = session::seedFault(text);
            return fault ? toText(*fault) : std::string();
          },
          "SEED"};
}

}  // namespace reachlab::cli
