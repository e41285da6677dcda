#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "analysis/analysis.h"

namespace reachlab::analysis {

/// Some trials of one log, by their numbers.
struct ChosenTrials {
  std::string log;
  std::vector<int> trials;
};

/// The chosen trials as `readDataset` would have given them, marks and all, in the order of the choice; trials that a log does not have,
/// and those of an experiment without a task, are left out. `goOn` is asked before each log: false leaves out the rest. Throws what reading a
/// log throws.
AnalysisInput readChosen(std::span<const ChosenTrials> chosen, const std::function<bool()>& goOn = {});

}  // namespace reachlab::analysis
