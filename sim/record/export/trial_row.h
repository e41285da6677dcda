#pragma once
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sim/record/log/trial_measures.h"

/// The columns of trials.csv, as every export of tables has them: names, sentences of the dictionary and cells follow one table.
namespace reachlab::record {

/// The task of a trial, by its scene. An experiment that this version cannot read any more leaves these cells empty.
experiment::Task taskOf(const RunConfiguration& configuration, const trial::PlannedTrial& planned);

const std::vector<std::string>& trialColumnNames();
/// The cells of each trial of a run, in the order of trialColumnNames.
using TrialCell = std::variant<double, std::string>;
void eachTrial(const RunLog& run, const std::function<void(std::span<const TrialCell> cells)>& take);
/// `table` takes cells of text and numbers (TableText, ColumnTable).
template <class Table>
void addTrial(Table& table, std::span<const TrialCell> cells) {
  for (const TrialCell& cell : cells) {
    if (const double* number = std::get_if<double>(&cell)) table.number(*number);
    else table.cell(std::get<std::string>(cell));
  }
  table.endRow();
}

}  // namespace reachlab::record
