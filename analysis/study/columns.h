#pragma once
#include <string>
#include <vector>

#include "analysis/study/design.h"

namespace reachlab::study {

/// A column of a study's table. All are numbers while they are computed and kept; what is text is a place in `words`.
struct Column {
  std::string name;
  std::vector<std::string> words;  // empty: a number
};

/// What has to be computed for the measures that are asked for, beside how each trial was judged.
struct Needs {
  bool samples = false;  // the recording at 100 Hz, in memory
  bool errors = false;   // predictions, and the paper's epsilon of each trial
  bool fits = false;     // the fits that a conclusion is made from
};
Needs needsOf(const Design& design);

/// Every column in order: who, which trial, its seed, what was varied, how it was judged, what was measured. `conditions`: of a plan.
std::vector<Column> columnsOf(const Design& design);
/// Columns up to the last varied one.
std::size_t identityColumns(const Design& design);
/// What each column is, beside the table (record/column_dictionary.h).
std::string dictionaryOf(const Design& design);

/// Names of the measures: columns of their own, and the families `epsilon` and `score`, a column a criterion.
std::vector<std::string> measureNames();
/// Those of a design that names none.
std::vector<std::string> usualMeasures();
/// Faults of `measures` and `criteria`.
std::vector<Fault> measureProblems(const Design& design);
/// The criteria by name that epsilon and score have columns for, without the reference.
std::vector<std::string> criteriaOf(const Design& design);

}  // namespace reachlab::study
