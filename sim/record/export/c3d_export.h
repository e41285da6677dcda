#pragma once
#include <string>
#include <vector>

#include "base/c3d_file.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// One trial as C3D has it: hand, device and masses as points in mm, everything else that is sampled but the clocks as analog channels in its
/// SI unit, a frame a sample, go, onset and end as events. Where no sample was recorded, or the device gave none, the point is not seen and a
/// signal is NaN.
C3dFile c3dOf(const RunLog& run, const RecordedTrial& trial);

/// Writes `sub-…_run-…_trial-….c3d` for each trial of these runs that has samples. Returns the files written. Throws ResourceError.
std::vector<std::string> writeC3d(const std::vector<RunLog>& runs, const std::string& folder);

}  // namespace reachlab::record
