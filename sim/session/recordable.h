#pragma once
#include "sim/session/programme.h"

namespace reachlab::session {

/// Throws FaultError where a recording of this could not be read again; planSession asks the same of what it has planned.
void checkRecordable(const Programme& programme);

}  // namespace reachlab::session
