#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "sim/record/log/run_log.h"
#include "sim/record/trial_marks.h"

namespace reachlab::analysis {

/// One recorded run, for the report's list of analysed runs.
struct AnalysedRun {
  record::RunConfiguration configuration;
  std::size_t trials = 0;
  std::string file = {};
  bool isLog = false;  // or a file of a dataset without logs
};

/// The content of a dataset without its trials.
struct DatasetIndex {
  std::vector<Condition> conditions;
  std::vector<AnalysedRun> runs;
  std::vector<std::string> notes;                              // what was left out or mended, one sentence each
  std::map<std::string, experiment::SquareMatrix<3>> trained;  // [N s/m] by subject: the viscous field of the latest run that had one
  std::vector<std::string> unreadable;                         // of those the runs that the disk did not give
};

/// Takes the trials run by run, so that no trial has to stay in memory. The last two may be empty.
struct TrialSink {
  std::function<void(TrialData&& trial, std::size_t condition)> add;  // of the condition with that index
  std::function<void()> beginRun = {};                                // the trials of a run follow
  std::function<void()> takeBackRun = {};                             // they are not to count: the run could not be read to its end
};

using DatasetProgress = std::function<void(std::size_t done, std::size_t of, const std::string& file)>;

/// Reads the dataset at `folder`, which may also be a session's folder or a single log. The logs in sourcedata/ are read. A dataset without
/// logs is read from its BIDS files, whose experiment must then be shipped or given in `experimentFile`. A damaged log is read to its last
/// good record and noted. If a run cannot be read to its end because the disk fails, all its trials are left out. Throws FaultError when
/// there is nothing to read.
DatasetIndex readDataset(const std::string& folder, const TrialSink& sink, const std::string& experimentFile = "",
                         const DatasetProgress& progress = {});

/// One run, ready to be made into trials. `rowsOf` gives the rows between two ticks. Logs and BIDS files are both read into this.
struct RunSource {
  record::RunConfiguration configuration;
  std::vector<record::RecordedTrial> trials;
  std::function<record::SampleRows(std::uint64_t first, std::uint64_t last)> rowsOf;
  record::RunMarks marks;  // what was said of the trials afterwards
};
/// The compiled scenes of runs. Runs of the same texts share them.
class ScenesOfRuns {
 public:
  /// Valid as long as this. Throws as record::recordedScenes does.
  const std::vector<experiment::CompiledExperiment>& of(const record::RunConfiguration& configuration);

 private:
  std::map<std::string, std::vector<experiment::CompiledExperiment>> known_;
};
/// Passes the run's trials to `sink`. The day of a run without a day is 0. `scenes` are the experiments of the configuration's scenes.
void addRun(const RunSource& run, std::span<const experiment::CompiledExperiment> scenes, DatasetIndex& index, const TrialSink& sink);

/// The experiments of a dataset without logs: those in its code/experiments/, or else the experiment of that name that is shipped now.
/// Throws FaultError if there is no such experiment.
struct BidsExperiments {
  std::vector<experiment::CompiledExperiment> scenes;
  bool own = false;  // of the dataset
};
BidsExperiments readBidsExperiments(const RunSource& run, const std::string& folder, const std::string& experimentFile = "");

/// The motion files of a dataset without logs, in order. Each file is a run.
std::vector<std::string> findBidsRuns(const std::string& folder);
/// The dataset's folder: above those of the subject, the session and the kind of data.
std::string datasetOf(const std::string& motionFile);
/// Reads such a run from its motion, channels and events files.
RunSource readBidsRun(const std::string& motionFile);

}  // namespace reachlab::analysis
