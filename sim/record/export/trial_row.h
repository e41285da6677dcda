#pragma once
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "sim/record/log/trial_measures.h"

/// The columns of trials.csv, as every export of tables has them: names, sentences of the dictionary and cells follow one table.
namespace reachlab::record {

/// The task of a trial, by its scene. An experiment that this version cannot read any more leaves these cells empty.
experiment::Task taskOf(const RunConfiguration& configuration, const trial::PlannedTrial& planned);

/// The cells of one trial, in the order of trialColumnNames.
using TrialCell = std::variant<double, std::string>;
std::vector<TrialCell> trialCells(const RunConfiguration& run, const experiment::Task& task, const RecordedTrial& trial,
                                  std::uint64_t firstSampleTick);
/// The tasks of a run's scenes, each read once.
class TasksOfRun {
 public:
  explicit TasksOfRun(const RunConfiguration& configuration) : configuration_(configuration) {}
  const experiment::Task& of(const trial::PlannedTrial& planned) {
    const auto known = tasks_.find(planned.scene);
    return known != tasks_.end() ? known->second : tasks_.emplace(planned.scene, taskOf(configuration_, planned)).first->second;
  }

 private:
  const RunConfiguration& configuration_;
  std::map<int, experiment::Task> tasks_;
};
const std::vector<std::string>& trialColumnNames();

/// `table` takes cells of text and numbers (TableText, ColumnTable).
template <class Table>
void addTrial(Table& table, const RunConfiguration& run, const experiment::Task& task, const RecordedTrial& trial,
              std::uint64_t firstSampleTick) {
  for (const TrialCell& cell : trialCells(run, task, trial, firstSampleTick)) {
    if (const double* number = std::get_if<double>(&cell)) table.number(*number);
    else table.cell(std::get<std::string>(cell));
  }
  table.endRow();
}

}  // namespace reachlab::record
