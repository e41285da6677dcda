#pragma once
#include "sim/session/session.h"

namespace reachlab::cli {

/// Conducts a session block by block. It prints one line per trial on stdout once the trial is safe on the disk. It writes the dataset at
/// each block's end and the success table at the end. Returns the exit code: 0, or 130 after Ctrl-C (the trial under way is kept as
/// interrupted). Throws the errors of planning, device, scene and disk. Finished trials are then on the disk.
int runSession(const session::SessionRequest& request);

}  // namespace reachlab::cli
