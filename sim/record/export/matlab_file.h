#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Writes one `sub-…_run-….mat` per run into `folder`. Each channel of the samples is a column vector under its column's name. The structs
/// `trials` and `events` have one field per column (numbers, or a cell array of text), for struct2table. `units`, `descriptions`, `clock`,
/// `software` and `experiment_json` are texts. The format is MAT version 5, which every reader of MAT files accepts. Each file is read back
/// and compared. A character beyond 16 bits is written as U+FFFD, since readers disagree about its length. Returns the files written.
/// Throws ResourceError.
std::vector<std::string> writeMatlab(const std::vector<RunLog>& runs, const std::string& folder);

/// UTF-8 as characters of 16 bits. Bytes that are no UTF-8, and characters that do not fit, become U+FFFD.
std::u16string utf16Of(const std::string& text);

}  // namespace reachlab::record
