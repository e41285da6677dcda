#pragma once
#include <string>

#include "sim/session/programme.h"

namespace reachlab::session {

/// Reads a plan's file and its experiments, compiles each once, and checks that their tasks can be carried out. Throws FaultError with
/// every fault, each at its position.
Programme checkedProgramme(const std::string& file);

}  // namespace reachlab::session
