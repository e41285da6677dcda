#pragma once
#include <string>

#include "sim/session/programme.h"

namespace reachlab::session {

/// A plan's file with the experiments that it names, each compiled once, and whether their tasks can be carried out. Throws FaultError with every
/// fault of all of them, each at its place.
Programme checkedProgramme(const std::string& file);

}  // namespace reachlab::session
