#pragma once
#include "sim/session/session.h"

namespace reachlab::cli {

/// Does a session block by block: conducts every trial, prints one line each on stdout once it is safe on the disk, writes the
/// dataset at each block's end and the success table at the end. Returns the exit code: 0, or 130 after Ctrl-C (the trial under
/// way is kept as interrupted). Throws what planning, device, scene and disk throw; finished trials are then on the disk.
int runSession(const session::SessionRequest& request);

}  // namespace reachlab::cli
