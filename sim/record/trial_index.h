#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// The names of a scene of a run (RunScene).
struct IndexedScene {
  std::string kind, target, condition;
};

/// A recorded run as a list of trials needs it.
struct IndexedRun {
  std::string path;            // of its log
  std::uint64_t bytes = 0;     // of the file when it was read, and when that
  std::int64_t changedNs = 0;  // was last written: another size or time is another run
  std::string subject, session, condition, experiment, device, startedUtc;
  int run = 0, block = 0, day = 0;
  bool practice = false, healthy = true;
  std::string loss;                  // lossOf its log
  std::vector<IndexedScene> scenes;  // empty: the run has only one
  std::vector<RecordedTrial> trials;
  const IndexedScene* sceneOf(const RecordedTrial& trial) const {
    return scenes.empty() ? nullptr : &scenes.at(static_cast<std::size_t>(trial.planned.scene));
  }
  const std::string& conditionOf(const RecordedTrial& trial) const { return scenes.empty() ? condition : sceneOf(trial)->condition; }
};

/// A run as its configuration describes it, without its trials.
IndexedRun indexedRunOf(const std::string& path, const RunConfiguration& configuration);

/// The trials of a dataset, a session or a single log, without their samples.
struct TrialIndex {
  std::vector<IndexedRun> runs;         // by the name of their logs
  std::vector<std::string> unreadable;  // logs that are left out, a sentence each
  std::size_t read = 0;                 // logs that had to be opened: the others were known from the index file
  std::size_t trialCount() const;
};

/// Called before each log that must be opened. False gives up, and the index then has the logs that were read so far.
using IndexProgress = std::function<bool(std::size_t done, std::size_t of)>;

/// The trials of every log that findLogs finds at `path`. Logs that have not changed are taken from `indexFile` (empty: no such file),
/// which is written again after a change. A damaged file, or a file of another version, is ignored. If the file cannot be written, only the
/// next opening takes longer. Throws FaultError where there are no logs.
TrialIndex openTrialIndex(const std::string& path, const std::string& indexFile, const IndexProgress& progress = {});

/// The name of the index file of `path` in the folder of such files. Every dataset has a different name.
std::string indexFileFor(const std::string& path, const std::string& folder);

}  // namespace reachlab::record
