#pragma once
#include <string>
#include <vector>

#include "analysis/study/design.h"
#include "sim/predict/prediction/criterion.h"

namespace reachlab::study {

/// A column of a study's table. Every column is kept as numbers. A text is kept as its index in `words`.
struct Column {
  std::string name;
  std::vector<std::string> words;  // empty: a number
};

/// The places of the first columns. Those from Session to CatchTrial are in studies of a plan alone. Trial and seed come next.
namespace column {
enum Place : std::size_t { Point, Subject, Session, Day, Block, Condition, Practice, CatchTrial, EndOfPlan };
}

/// The computations that the requested measures need, beside the judgement of each trial.
struct Needs {
  bool samples = false;  // the recording at 100 Hz, in memory
  bool errors = false;   // predictions, and the paper's epsilon of each trial
  bool fits = false;     // the fits that a conclusion is made from
};
Needs needsOf(const Design& design);

/// Every column in order: subject, trial, seed, varied keys, judgement, measures.
std::vector<Column> columnsOf(const Design& design);
/// The number of columns up to the last varied key.
std::size_t identityColumns(const Design& design);
/// The dictionary of the columns (record/column_dictionary.h).
std::string dictionaryOf(const Design& design);

/// Names of the measures: single columns, and the families `epsilon` and `score` with a column for each criterion.
std::vector<std::string> measureNames();
/// The measures of a design that names no measures.
std::vector<std::string> usualMeasures();
/// Faults of `measures` and `criteria`.
std::vector<Fault> measureProblems(const Design& design);
/// The criteria that epsilon and score have columns for, without the reference.
std::vector<predict::Criterion> criteriaOf(const Design& design);

}  // namespace reachlab::study
