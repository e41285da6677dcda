#pragma once
#include <string>
#include <vector>

#include "base/vec3.h"

namespace reachlab::devices {

/// Recorded hand positions at uneven times.
struct RecordedReach {
  std::string file;
  std::vector<double> time;    // [s] strictly increasing
  std::vector<Vec3> position;  // [m] in the recording's own frame
};

/// Reads a CSV file whose header names time_s, x_m, y_m and z_m, in any order and among others; at least one row. Throws ResourceError when
/// the file cannot be opened, FaultError (FILE:LINE: COLUMN) for what is not such a table.
RecordedReach readReach(const std::string& file);

}  // namespace reachlab::devices
