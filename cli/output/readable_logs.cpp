#include "cli/output/readable_logs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <exception>

#include "base/error.h"
#include "sim/record/log/append_file.h"

namespace reachlab::cli {

void ReadableLogs::tellUnreadable() const {
  if (unreadable.empty()) return;
  throw ResourceError(fmt::format("{} of {} logs cannot be read and are left out: {}", unreadable.size(), unreadable.size() + runs.size(),
                                  fmt::join(unreadable, "; ")));
}

ReadableLogs openReadableLogs(const std::string& what, OpenLogs open) {
  ReadableLogs logs;
  std::exception_ptr first;
  for (const std::string& path : record::findLogs(what)) {
    if (open == OpenLogs::LeaveOut && record::isBeingWritten(path)) {
      logs.open.push_back(path);
      continue;
    }
    try {
      logs.runs.push_back(record::RunLog::open(path));
    } catch (const Error& error) {
      if (!first) first = std::current_exception();
      logs.unreadable.emplace_back(error.what());
    }
  }
  if (logs.runs.empty() && first) std::rethrow_exception(first);
  if (logs.runs.empty()) throw ResourceError(logs.open.front() + ": is being recorded into; end that run first");
  return logs;
}

}  // namespace reachlab::cli
