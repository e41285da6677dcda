#pragma once
#include <map>
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::analysis {

/// Finds runs that are one and the same movement recorded again: a simulated subject with the same seed, a file replayed twice. Counted
/// together they would inflate every statistic. Runs are equal if subject, session and experiment are equal, and outcome, moments and
/// measures of each trial to the last bit. No two movements of a person are that equal.
class EqualRuns {
 public:
  /// The file of an earlier run that this run repeats. If it is empty, the run is known under `file` from now on.
  std::string twinOf(const std::string& file, const record::RunConfiguration& configuration,
                     const std::vector<record::RecordedTrial>& trials);
  /// Forgets a run that does not count after all. A later repetition then counts as the first run.
  void forget(const std::string& file);

 private:
  std::map<std::string, std::string> fileOf_;
};

/// How many of the run's trials repeat an earlier trial of it to the last bit, as with `noise=0`. Such trials count.
int countRepeats(const std::vector<record::RecordedTrial>& trials);

}  // namespace reachlab::analysis
