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

/// Where another laboratory's file has time and place. What is empty is found by name: time_s, time_ms, x_m, x_cm, x_mm …
struct ReachColumns {
  std::string time, x, y, z;   // names of columns; z may be missing where x and y are named: the hand moved in a plane
  std::string unit, timeUnit;  // m, cm, mm and s, ms; empty: told by the column's name or the file
  std::optional<double> rate;  // [1/s] of a table without a column of times
  std::string point;           // a tracked point (BIDS) or marker (C3D); empty: the only one
  std::string trialType;       // BIDS: only events of this type are reaches; empty: all that last
};

/// Reads a CSV file with a header, separated by commas, semicolons or tabs; at least one row. Throws ResourceError when the file cannot be
/// opened, FaultError (FILE:LINE: COLUMN) for what is not such a table.
RecordedReach readReach(const std::string& file, const ReachColumns& columns = {});

/// Reads `…_motion.tsv` of a BIDS dataset with its `…_channels.tsv`, the rate from the LATENCY channel or from `…_motion.json`; with `…_events.tsv`
/// each event that lasts is a reach, without the whole file is one. Throws as readReach does.
std::vector<RecordedReach> readBidsReaches(const std::string& motionTsv, const ReachColumns& columns);

/// Reads one point of a C3D file. Throws as readReach does.
RecordedReach readC3dReach(const std::string& file, const ReachColumns& columns);

/// The length of `unit` in metres, of a time in seconds. Throws FaultError `ORIGIN: what; allowed: …`.
double metresOf(const std::string& unit, const FilePlace& place, const std::string& key = {});
double secondsOfUnit(const std::string& unit, const FilePlace& place, const std::string& key = {});

/// A tracking system's samples, of which some were not seen: what is missing at the ends is left off, a gap of up to 0.1 s is left to the spline.
/// Throws FaultError for a longer one, or when nothing was seen.
class SeenSamples {
 public:
  explicit SeenSamples(std::string file) { reach_.file = std::move(file); }
  void add(double time, const Vec3& position);
  void miss() { missed_ = true; }
  RecordedReach take();

 private:
  RecordedReach reach_;
  bool missed_ = false;  // since the last that was seen
};

}  // namespace reachlab::devices
