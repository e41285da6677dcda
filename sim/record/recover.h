#pragma once
#include <cstdint>
#include <string>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

struct Recovery {
  bool mended = false;          // false: the log was healthy and is as it was
  std::string damagedOriginal;  // where the log as found was kept
  std::uint64_t keptBytes = 0, lostBytes = 0;
  int trials = 0;  // in the mended log, the interrupted one included
  bool interruptedTrial = false;
};

/// Repairs a log in place. Everything before the first damage stays byte for byte. A trial that was under way there is closed as
/// `interrupted`, and the log is ended in order. The log as found is kept beside it (`….damaged`). A healthy log is not changed. Throws
/// FaultError (no log, configuration damaged) or ResourceError (disk, or the log is being written).
Recovery recoverLog(const std::string& path);

/// A sentence about a log that was not closed in order or is damaged. It names the trial that broke off, and the planned trials that are
/// missing. Empty for a healthy log, and for one that is being recorded into.
std::string lossOf(const RunLog& log);

}  // namespace reachlab::record
