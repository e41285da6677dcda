#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Writes one `sub-…_run-….h5` a run into `folder`: groups /samples, /trials and /events with a data set a column (float64, or UTF-8 strings of
/// any length); samples carry `units` and `description`; the file carries `clock`, `software`, and the experiment's text. Returns the files
/// written. Throws ResourceError.
std::vector<std::string> writeHdf5(const std::vector<RunLog>& runs, const std::string& folder);

/// Before the first call of the HDF5 library, also by another one: it prints nothing (we say one sentence), and does not put in order at the
/// program's end what a full disk has left open, which crashes.
void prepareHdf5();

}  // namespace reachlab::record
