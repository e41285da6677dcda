#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::cli {

/// The logs of a dataset, a session's folder or one log, and those logs that cannot be read.
struct ReadableLogs {
  std::vector<record::RunLog> runs;
  std::vector<std::string> unreadable;  // one sentence each, with the log's name
  std::vector<std::string> open;        // logs that are being recorded into and were asked to be left out
  /// To be called after the work on the readable logs. Throws ResourceError naming the unreadable logs.
  void tellUnreadable() const;
};
enum class OpenLogs { Read, LeaveOut };
/// Throws the error of the first log where no log can be read, and ResourceError where all of them are left out.
ReadableLogs openReadableLogs(const std::string& what, OpenLogs open = OpenLogs::Read);

}  // namespace reachlab::cli
