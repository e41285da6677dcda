#pragma once
#include <map>
#include <string>
#include <vector>

#include "sim/trial/outcome.h"

namespace reachlab::cli {

/// Counts of a run, as printed at its end. The exported trials.csv gives the same.
struct OutcomeCounts {
  int trials = 0, success = 0, failure = 0, aborted = 0, interrupted = 0;
  std::map<std::string, int> reasons;  // of trials without success
};

/// Outcomes by condition, in the order in which the conditions came.
class SuccessTable {
 public:
  void add(const std::string& condition, const trial::TrialResult& result);
  /// Columns: condition, trials, success, failure, aborted, interrupted, success_percent, reasons. Empty without trials.
  std::string text() const;

 private:
  std::vector<std::pair<std::string, OutcomeCounts>> rows_;
};

}  // namespace reachlab::cli
