#pragma once
#include "sim/session/programme.h"

namespace reachlab::session {

/// Throws FaultError where a recording of this programme could not be read again. planSession checks the same.
void checkRecordable(const Programme& programme);

}  // namespace reachlab::session
