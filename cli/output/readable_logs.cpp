#include "cli/output/readable_logs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <exception>

#include "base/error.h"

namespace reachlab::cli {

void ReadableLogs::tellUnreadable() const {
  if (unreadable.empty()) return;
  throw ResourceError(fmt::format("{} of {} logs cannot be read and are left out: {}", unreadable.size(), unreadable.size() + runs.size(),
                                  fmt::join(unreadable, "; ")));
}

ReadableLogs openReadableLogs(const std::string& what) {
  ReadableLogs logs;
  std::exception_ptr first;
  for (const std::string& path : record::findLogs(what)) {
    try {
      logs.runs.push_back(record::RunLog::open(path));
    } catch (const Error& error) {
      if (!first) first = std::current_exception();
      logs.unreadable.emplace_back(error.what());
    }
  }
  if (logs.runs.empty() && first) std::rethrow_exception(first);
  return logs;
}

}  // namespace reachlab::cli
