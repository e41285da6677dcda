#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/table_text.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Writes `trials.csv` (one row a trial of all the runs) and one `sub-…_ses-…_task-…_run-…_samples.csv` a run into `folder`, for
/// R, JASP, SPSS, pandas; beside each a dictionary of its columns (`trials.json` …). Returns the files written. Throws ResourceError.
std::vector<std::string> writeTidyCsv(const std::vector<RunLog>& runs, const std::string& folder);

// The texts of the files, given piece by piece: they grow with the run, memory does not.
void trialsCsv(const std::vector<RunLog>& runs, const TakePiece& take);
void samplesCsv(const RunLog& run, const TakePiece& take);
/// Every row of the run as a line of `table`, which may have a header already. With `columns`, only those.
void writeRows(const RunLog& run, TableText table, const TakePiece& take);
void writeRows(const RunLog& run, std::span<const std::size_t> columns, TableText table, const TakePiece& take);
/// What each column of these files is, in words, with its unit.
std::string trialsDictionary(std::string_view csv);
std::string samplesDictionary(const RunLog& run, std::string_view csv);

/// `sub-01_ses-01_task-chainmoderate_run-01`: the BIDS name of a run without `tracksys` and suffix.
std::string runName(const RunConfiguration& configuration, const std::string& between = "");

/// What an outcome's `by` is measured in: m, m/s, s or nothing.
std::string unitOf(trial::Reason reason);

}  // namespace reachlab::record
