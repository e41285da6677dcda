#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Write one `sub-…_run-….mat` a run into `folder`: a column vector for each channel of the samples, under its column's name; structs `trials`
/// and `events` with a field a column (numbers, or a cell array of text), for struct2table; `units`, `descriptions`, `clock`, `software`,
/// `experiment_json`. Version 5 is read by everything that reads MAT files; 7.3 is HDF5 inside, for variables beyond 2 GB. What is written is
/// read back and compared. A character beyond 16 bits is U+FFFD in version 5: readers count it as one where it is two. Returns the files written.
/// Throws ResourceError.
std::vector<std::string> writeMatlab5(const std::vector<RunLog>& runs, const std::string& folder);
std::vector<std::string> writeMatlab73(const std::vector<RunLog>& runs, const std::string& folder);

/// UTF-8 as MATLAB's characters have it, 16 bits each; what is no UTF-8 becomes U+FFFD, and without `pairs` what takes two of them.
std::u16string utf16Of(const std::string& text, bool pairs = true);

}  // namespace reachlab::record
