#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::cli {

/// The logs of a dataset, a session's folder or one log, and those logs that cannot be read.
struct ReadableLogs {
  std::vector<record::RunLog> runs;
  std::vector<std::string> unreadable;  // one sentence each, with the log's name
  /// To be called after the work on the readable logs. Throws ResourceError naming the unreadable logs.
  void tellUnreadable() const;
};
/// Throws the error of the first log where no log can be read.
ReadableLogs openReadableLogs(const std::string& what);

}  // namespace reachlab::cli
