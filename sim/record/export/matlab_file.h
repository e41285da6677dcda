#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Write one `sub-…_run-….mat` a run into `folder`: a column vector for each channel of the samples, under its column's name; structs `trials`
/// and `events` with a field a column (numbers, or a cell array of text), for struct2table; `units`, `descriptions`, `clock`, `software`,
/// `experiment_json`. MAT version 5, which everything reads that reads MAT files. What is written is read back and compared. A character
/// beyond 16 bits is written as U+FFFD: readers count it as one where it is two. Returns the files written. Throws ResourceError.
std::vector<std::string> writeMatlab(const std::vector<RunLog>& runs, const std::string& folder);

/// UTF-8 as characters of 16 bits. What is no UTF-8, or does not fit, becomes U+FFFD.
std::u16string utf16Of(const std::string& text);

}  // namespace reachlab::record
