#pragma once
#include <set>
#include <vector>

#include "sim/record/log/run_log.h"
#include "sim/session/session_folder.h"

namespace reachlab::session {

/// One block as far as it is recorded: its first run and those that resumed it.
struct RecordedBlock {
  record::RunConfiguration configuration;  // of the first run
  std::set<int> done = {};                  // planned indices that were finished, and are not to be repeated
  std::set<int> putUpAgain = {};           // or to be repeated, once
  bool complete() const { return done.size() >= configuration.trials.size(); }
  int lastTrial = 0;  // largest trial number used so far
};

/// The session's blocks as recorded, by first run. Logs that cannot be read at all are left out, with a sentence in `faults`; with `mustRead` one
/// that the disk does not give is a ResourceError: whoever resumes would do again what it holds.
std::vector<RecordedBlock> readRecordedBlocks(const SessionPlace& place, std::vector<std::string>& faults, bool mustRead = false);

}  // namespace reachlab::session
