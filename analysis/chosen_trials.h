#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "analysis/dataset.h"
#include "sim/record/trial_index.h"

namespace reachlab::analysis {

/// A recorded run with its experiments, from a log or, of a dataset without logs, from a motion file.
struct Recording {
  RunSource run;
  std::vector<experiment::CompiledExperiment> scenes;
};
/// `known`: experiments that were compiled before. Throws as the readers of logs and of BIDS files do.
Recording openRecording(const std::string& path, ScenesOfRuns& known);
/// Whether the run is read from BIDS files, because there is no log.
bool isMotionFile(const std::string& path);

/// The runs of a dataset without logs, as openTrialIndex gives those of logs. A run that cannot be read is left out and named. Throws
/// FaultError where there is no motion file of Reachlab, and names the tracking systems of the other files.
record::TrialIndex indexMotionFiles(const std::string& folder, const record::IndexProgress& progress = {});

/// Some trials of one log or motion file, by their numbers.
struct ChosenTrials {
  std::string log;
  std::vector<int> trials;
};

/// The chosen trials as `readDataset` gives them, with their marks, in the order of the choice. Trials that a log does not have are left
/// out, and so are trials of an experiment without a task. `goOn` is asked before each log. If it answers false, the remaining logs are
/// left out. Throws as the reader of logs does.
AnalysisInput readChosen(std::span<const ChosenTrials> chosen, const std::function<bool()>& goOn = {});

/// Called before each trial that is read and after each that is fitted. An exception from it ends the analysis.
using ChosenProgress = std::function<void()>;
/// What `analyzeTrials` gives for `readChosen`, but each trial's samples are forgotten before the next trial is read.
Analysis analyzeChosen(std::span<const ChosenTrials> chosen, const AnalysisOptions& options, const ChosenProgress& progress = {});

}  // namespace reachlab::analysis
