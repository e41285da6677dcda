#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Writes one `sub-…_run-….h5` per run into `folder`. The groups /samples, /trials and /events have one data set per column (float64, or
/// UTF-8 strings of any length). Samples carry `units` and `description`. The file carries `clock`, `software`, and the experiment's text.
/// Returns the files written. Throws ResourceError.
std::vector<std::string> writeHdf5(const std::vector<RunLog>& runs, const std::string& folder);

/// To be called before the first call of the HDF5 library, also by another library. HDF5 then prints nothing, since the caller reports the
/// fault in one sentence. It also does not close at the program's end the files that a full disk has left open, which crashes.
void prepareHdf5();

}  // namespace reachlab::record
