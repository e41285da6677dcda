#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/table_text.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Writes `trials.csv` (one row per trial of all runs) and one `sub-…_ses-…_task-…_run-…_samples.csv` per run into `folder`. R, JASP, SPSS
/// and pandas read them. Beside each is a dictionary of its columns (`trials.json` …). Returns the files written. Throws ResourceError.
std::vector<std::string> writeTidyCsv(const std::vector<RunLog>& runs, const std::string& folder);

// The texts of the files, piece by piece. They grow with the run, but the memory does not.
void trialsCsv(const std::vector<RunLog>& runs, const TakePiece& take);
void samplesCsv(const RunLog& run, const TakePiece& take);
/// Those columns of every row of the run as lines of `table`, which may have a header already.
void writeRows(const RunLog& run, std::span<const std::size_t> columns, TableText table, const TakePiece& take);
/// The meaning of each column of these files, with its unit.
std::string trialsDictionary(std::string_view csv);
std::string samplesDictionary(const RunLog& run, std::string_view csv);

/// `sub-01_ses-01_task-chainmoderate_run-01`: the BIDS name of a run without `tracksys` and suffix.
std::string runName(const RunConfiguration& configuration, const std::string& between = "");

/// The unit of an outcome's `by`: m, m/s, s or no unit.
std::string unitOf(trial::Reason reason);

}  // namespace reachlab::record
