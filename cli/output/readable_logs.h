#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::cli {

/// The logs of a dataset, a session's folder or one log, and what cannot be read among them.
struct ReadableLogs {
  std::vector<record::RunLog> runs;
  std::vector<std::string> unreadable;  // one sentence each, with the log's name
  /// To be called when the work on the others is done. Throws ResourceError naming the logs.
  void tellUnreadable() const;
};
/// Throws what the first log throws where none can be read.
ReadableLogs openReadableLogs(const std::string& what);

}  // namespace reachlab::cli
