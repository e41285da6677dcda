#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "sim/record/log/run_log.h"
#include "sim/record/trial_marks.h"

namespace reachlab::analysis {

/// One recorded run, for the report's list of what was analysed.
struct RunProvenance {
  std::string file, subject, session, condition, experiment, device, method, software, startedUtc, clock;
  int run = 0, block = 0, day = 0;
  bool practice = false;
  std::uint64_t seed = 0;
  double samplingHz = 0;
  std::size_t trials = 0;
  bool healthy = true;
};

/// What a dataset is made of, but for its trials.
struct DatasetIndex {
  std::vector<Condition> conditions;
  std::vector<RunProvenance> runs;
  std::vector<std::string> notes;       // what was left out or mended, one sentence each
  std::vector<std::string> unreadable;  // of those the runs that the disk did not give
};

/// Takes the trials run by run, so that none need stay in memory.
struct TrialSink {
  std::function<void(TrialData&& trial, std::size_t condition)> add;  // of the condition with that index
  std::function<void(std::size_t count)> takeBack;                    // the last so many: their run could not be read to its end
};

using DatasetProgress = std::function<void(std::size_t done, std::size_t of, const std::string& file)>;

/// Reads the dataset at `folder` (a session's folder or a single log do too): from the logs in sourcedata/, or where there are none from
/// the BIDS files, whose experiment must then be a shipped one or given in `experimentFile`. A damaged log is read to its last good
/// record and noted. A run is in or out: one that cannot be read to its end (a disk that fails) leaves no trial behind. Throws FaultError
/// when there is nothing to read.
DatasetIndex readDataset(const std::string& folder, const TrialSink& sink, const std::string& experimentFile = "",
                         const DatasetProgress& progress = {});

/// What a run's rows are turned into; `rowsOf` gives the rows between two ticks. Shared by both ways of reading.
struct RunSource {
  record::RunConfiguration configuration;
  std::vector<record::RecordedTrial> trials;
  std::function<record::SampleRows(std::uint64_t first, std::uint64_t last)> rowsOf;
  record::RunMarks marks;  // what was said of the trials afterwards
};
/// Hands on the run's trials; the day of a run without one is 0.
void addRun(const RunSource& run, const experiment::CompiledExperiment& experiment, DatasetIndex& index, const TrialSink& sink);

/// The runs of a dataset without logs, by their motion files, in order.
std::vector<std::string> findBidsRuns(const std::string& folder);
/// One of them, from its motion, channels and events files.
RunSource readBidsRun(const std::string& motionFile);

}  // namespace reachlab::analysis
