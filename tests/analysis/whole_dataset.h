#pragma once
#include <string>
#include <utility>

#include "analysis/analysis.h"
#include "analysis/dataset.h"

namespace reachlab::analysis {

/// A dataset with every trial kept in memory.
struct Dataset : DatasetIndex {
  AnalysisInput input;
};

inline Dataset openDataset(const std::string& folder, const std::string& experimentFile = "") {
  Dataset dataset;
  AnalysisInput& input = dataset.input;
  std::size_t begin = 0;
  static_cast<DatasetIndex&>(dataset) = readDataset(folder,
                                                    {[&](TrialData&& trial, std::size_t condition) {
                                                       input.trials.push_back(std::move(trial));
                                                       input.conditionOf.push_back(condition);
                                                     },
                                                     [&] { begin = input.trials.size(); },
                                                     [&] {
                                                       input.trials.resize(begin);
                                                       input.conditionOf.resize(begin);
                                                     }},
                                                    experimentFile);
  input.conditions = dataset.conditions;
  return dataset;
}

/// For tests of what does not depend on the criteria, which take most of an analysis's computation time.
inline AnalysisOptions fewCriteria() {
  AnalysisOptions options;
  options.criteria = {predict::Criterion::MinHandJerk, predict::Criterion::MinCrackle};
  return options;
}

}  // namespace reachlab::analysis
