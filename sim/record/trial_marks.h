#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// A person's remarks about a recorded trial, made during the run or long after it. SI, seconds since the trial was armed.
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
  /// Replaces the mark of that trial. An empty mark removes it.
  void set(const TrialMark& mark);
  bool operator==(const RunMarks&) const = default;
};

/// The file of a log's marks, beside it: `…_log.reach` and `…_marks.json`. The log itself is never touched.
std::string marksPathOf(const std::string& logPath);
/// Reads the marks. A missing file gives no marks. Throws ResourceError, and FaultError with every fault of the file at its position. A
/// trial that is named twice is refused, because the later line would undo the exclusion in the earlier line.
RunMarks readMarks(const std::string& logPath);
/// The same for a finished run: a trial that the run does not have is refused too, because it is a mistake.
RunMarks readMarks(const RunLog& run);
/// Replaces the file in one step. Without marks the file is removed. Throws ResourceError.
void writeMarks(const std::string& logPath, const RunMarks& marks);

}  // namespace reachlab::record
