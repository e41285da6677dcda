#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sim/analyze/study.h"
#include "sim/record/run_log.h"

namespace reachlab::analyze {

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

/// A dataset read into memory.
struct Dataset {
  StudyInput input;
  std::vector<RunProvenance> runs;
  std::vector<std::string> notes;  // what was left out or mended, one sentence each
};

using DatasetProgress = std::function<void(std::size_t done, std::size_t of, const std::string& file)>;

/// Reads the dataset at `folder` (a session's folder or a single log do too): from the logs in sourcedata/, or where there are none from
/// the BIDS files, whose experiment must then be a shipped one or given in `experimentFile`. A damaged log is read to its last good
/// record and noted. Throws UsageError when there is nothing to read.
Dataset openDataset(const std::string& folder, const std::string& experimentFile = "", const DatasetProgress& progress = {});

/// What a run's rows are turned into; `rowsOf` gives the rows between two ticks. Shared by both ways of reading.
struct RunSource {
  record::RunConfiguration configuration;
  std::vector<record::RecordedTrial> trials;
  std::function<record::SampleRows(std::uint64_t first, std::uint64_t last)> rowsOf;
};
/// Adds the run's trials; the day of a run without one is 0 until numberDays.
void addRun(const RunSource& run, const experiment::Experiment& experiment, Dataset& dataset);
/// Where the plan gave no day, the subject's sessions are days 1, 2, … in their order.
void numberDays(std::span<TrialData> trials);

/// The runs of a dataset without logs, from its motion, channels and events files.
std::vector<RunSource> readBidsRuns(const std::string& folder);

}  // namespace reachlab::analyze
