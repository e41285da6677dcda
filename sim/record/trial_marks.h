#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// What a person says of a recorded trial, while the run goes on or long after. SI, seconds since the trial was armed.
struct TrialMark {
  int trial = 0;                                  // as recorded
  bool flagged = false;                           // to be looked at again; counts like any other
  std::string excluded = {};                      // why it is not to count; empty: it counts
  std::optional<double> onset = {}, offset = {};  // [s] of the movement, where the rule's were moved by hand
  std::string note = {};
  bool empty() const { return !flagged && excluded.empty() && !onset && !offset && note.empty(); }
  bool operator==(const TrialMark&) const = default;
};

/// The marks of one run, by trial.
struct RunMarks {
  std::vector<TrialMark> trials;
  const TrialMark* find(int trial) const;  // null: nothing was said of it
  /// In place of what was said of that trial; an empty one forgets it.
  void set(const TrialMark& mark);
  bool operator==(const RunMarks&) const = default;
};

/// Where the marks of a log stand: beside it, `…_log.reach` and `…_marks.json`. The log itself is never touched.
std::string marksPathOf(const std::string& logPath);
/// None where there is no such file. Throws FaultError with every fault of the file at its place, ResourceError. A trial that is named twice
/// is refused, because the later line would undo the exclusion of the earlier one.
RunMarks readMarks(const std::string& logPath);
/// The same of a run that is over: a trial that the run does not have is refused too, because another one was meant.
RunMarks readMarks(const RunLog& run);
/// Replaces the file in one step; without marks there is none. Throws ResourceError.
void writeMarks(const std::string& logPath, const RunMarks& marks);

}  // namespace reachlab::record
