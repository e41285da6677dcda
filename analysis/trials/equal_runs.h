#pragma once
#include <map>
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::analysis {

/// Finds runs that are one and the same movement recorded again: a simulated subject with the same seed, a file replayed twice. Counted
/// together they would inflate every statistic. Equal are the subject, the session, the experiment, and of each trial outcome, moments
/// and measures to the last bit; no two movements of a person are.
class EqualRuns {
 public:
  /// The file of an earlier run that this one repeats, else empty; the run is then known under `file`.
  std::string twinOf(const std::string& file, const record::RunConfiguration& configuration,
                     const std::vector<record::RecordedTrial>& trials);
  /// The run does not count after all: who repeats it is the first.
  void forget(const std::string& file);

 private:
  std::map<std::string, std::string> fileOf_;
};

/// How many of the run's trials repeat an earlier one of the same run to the last bit (`noise=0` does); they count.
int countRepeats(const std::vector<record::RecordedTrial>& trials);

}  // namespace reachlab::analysis
