#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "base/math/vec3.h"

namespace reachlab::devices {

/// Recorded hand positions at uneven times.
struct RecordedReach {
  std::string file;
  std::vector<double> time;    // [s] strictly increasing
  std::vector<Vec3> position;  // [m] in the recording's own frame
};

/// The columns of another laboratory's file that hold time and position. An empty name is found by search: time_s, time_ms, x_m, x_cm, x_mm
/// …
struct ReachColumns {
  std::string time, x, y, z;   // names of columns; z may be missing where x and y are named: the hand moved in a plane
  std::string unit, timeUnit;  // m, cm, mm and s, ms; empty: found in the column's name or the file
  std::optional<double> rate;  // [1/s] of a table without a column of times
  std::string point;           // a tracked point (BIDS) or marker (C3D); empty: the only point
  std::string trialType;       // BIDS: only events of this type are reaches; empty: all events with a duration
};

/// Reads a CSV file with a header and at least one row, separated by commas, semicolons or tabs. Throws ResourceError when the file cannot
/// be opened, FaultError (FILE:LINE: COLUMN) when it is no such table.
RecordedReach readReach(const std::string& file, const ReachColumns& columns = {});

/// Reads `…_motion.tsv` of a BIDS dataset with its `…_channels.tsv`. The rate comes from the LATENCY channel or from `…_motion.json`. With
/// `…_events.tsv`, each event with a duration is a reach. Without events, the whole file is one reach. Throws as readReach does.
std::vector<RecordedReach> readBidsReaches(const std::string& motionTsv, const ReachColumns& columns);

/// Reads one point of a C3D file. Of our own trials in which the hand stayed (an event `end` and no `onset`) nullopt. Throws as readReach does.
std::optional<RecordedReach> readC3dReach(const std::string& file, const ReachColumns& columns);

}  // namespace reachlab::devices
