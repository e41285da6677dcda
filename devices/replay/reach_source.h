#pragma once
#include <string>
#include <vector>

#include "devices/replay/recorded_reach.h"

namespace reachlab::devices {

/// What is behind `replay:`: a file or a folder, and how its files are to be read.
struct ReachSource {
  std::string path;
  ReachColumns columns;
};
/// PATH[,KEY=VALUE…]; a path that exists as it stands is one, whatever commas are in it. Throws FaultError for an unknown key or value.
ReachSource reachSourceOf(const std::string& argument);

/// The files that `path` stands for: itself, or the folder's CSV files, BIDS motion files and C3D files in name order. Throws ResourceError when
/// there are none.
std::vector<std::string> reachFiles(const std::string& path);

/// Every reach of the source. Throws as readReach does.
std::vector<RecordedReach> readReaches(const ReachSource& source);

}  // namespace reachlab::devices
