#pragma once
#include <set>
#include <vector>

#include "sim/record/log/run_log.h"
#include "sim/session/session_folder.h"

namespace reachlab::session {

/// The recorded part of a block: its first run and the runs that resumed it.
struct RecordedBlock {
  record::RunConfiguration configuration;  // of the first run
  std::set<int> done = {};                 // planned indices that are finished and not to be repeated
  std::set<int> putUpAgain = {};           // planned indices that are to be repeated once
  bool complete() const { return done.size() >= configuration.trials.size(); }
  int lastTrial = 0;  // largest trial number used so far
};

/// True for a recording of that block of a plan. Blocks are numbered on each day from 1.
bool isBlockOf(const record::RunConfiguration& c, const std::string& planText, int day, int block);

/// The session's recorded blocks, by first run. Logs that cannot be read are left out, with a sentence in `faults`. With `mustRead` a log
/// that the disk does not give is a ResourceError, since resuming would repeat its trials.
std::vector<RecordedBlock> readRecordedBlocks(const SessionPlace& place, std::vector<std::string>& faults, bool mustRead = false);

/// The device of the last of a session's recorded blocks, if it differs from `device`: trials with two devices may not be comparable. Otherwise
/// empty.
std::string otherDeviceBefore(const std::vector<RecordedBlock>& blocks, const std::string& device);

}  // namespace reachlab::session
