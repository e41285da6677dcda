#pragma once
#include <string>
#include <vector>

#include "devices/replay/recorded_reach.h"

namespace reachlab::devices {

/// The source behind `replay:`: a file or a folder, and the options for reading its files.
struct ReachSource {
  std::string path;
  ReachColumns columns;
};
/// PATH[,KEY=VALUE…]. If the whole text is an existing path, it is the path, even with commas in it. Throws FaultError for an unknown key
/// or value.
ReachSource reachSourceOf(const std::string& argument);

/// The files of `path`: the file itself, or the folder's CSV files, BIDS motion files and C3D files in the order of their names. Throws
/// ResourceError when there is no file.
std::vector<std::string> reachFiles(const std::string& path);

/// Every reach of the source. Throws as readReach does.
std::vector<RecordedReach> readReaches(const ReachSource& source);

}  // namespace reachlab::devices
