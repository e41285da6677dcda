#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/simulated/played_hand.h"

namespace reachlab::devices {

/// Recorded hand positions at uneven times; columns time_s,x_m,y_m,z_m of a CSV file.
struct RecordedReach {
  std::string file;
  std::vector<double> time;    // [s] strictly increasing
  std::vector<Vec3> position;  // [m] in the recording's own frame
};

/// Throws ResourceError when the file cannot be opened, UsageError (FILE:LINE) for what is not such a table, or no movement in it.
RecordedReach readReach(const std::string& file);

/// The reach laid onto start -> target: its chord, from the first sample to the one farthest from it, is moved, turned by the smallest
/// rotation and scaled uniformly; time is not scaled. The hand rests at the start for 0.3 s, joins the recorded path by a minimum-jerk
/// blend over 0.1 s, follows a cubic spline (C2, natural ends) through the samples, and holds the last one. Velocity is left to the
/// estimator, as with any device that has none.
PlayedReach layOnto(const RecordedReach& reach, const Vec3& start, const Vec3& target);

/// The files that `path` stands for: itself, or the CSV files of the folder in name order. Throws ResourceError when there are none.
std::vector<std::string> reachFiles(const std::string& path);

/// A device that plays the file, or the CSV files of a folder in name order, one a trial, again from the first.
std::unique_ptr<haptics::HapticDevice> makeReplayHand(const std::string& path, const Vec3& start, const Vec3& target);

}  // namespace reachlab::devices
