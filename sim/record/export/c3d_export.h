#pragma once
#include <string>
#include <vector>

#include "base/c3d_file.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// One trial in the form of C3D, with one frame per sample. Hand, device and masses are points in mm. All other channels except the clocks
/// are analog channels in their SI units. Go, onset and end are events. Where a sample is missing, or the device gave no value, the point
/// is not seen and a signal is NaN.
C3dFile c3dOf(const RunLog& run, const RecordedTrial& trial);

/// Writes `sub-…_run-…_trial-….c3d` for each trial of these runs that has samples. Returns the files written. Throws ResourceError.
std::vector<std::string> writeC3d(const std::vector<RunLog>& runs, const std::string& folder);

}  // namespace reachlab::record
