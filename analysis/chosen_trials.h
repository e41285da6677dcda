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

/// The chosen trials as `readDataset` gives them, with their marks, in the order of the choice. Trials that a log does not have are left
/// out, and so are trials of an experiment without a task. `goOn` is asked before each log. If it answers false, the remaining logs are
/// left out. Throws as the reader of logs does.
AnalysisInput readChosen(std::span<const ChosenTrials> chosen, const std::function<bool()>& goOn = {});

}  // namespace reachlab::analysis
/// Called before each trial that is read and after each that is fitted. An exception from it ends the analysis.
using ChosenProgress = std::function<void()>;
/// What `analyzeTrials` gives for `readChosen`, but each trial's samples are forgotten before the next trial is read.
Analysis analyzeChosen(std::span<const ChosenTrials> chosen, const AnalysisOptions& options, const ChosenProgress& progress = {});

