#include "devices/replay/reach_source.h"

#include <algorithm>
#include <filesystem>

#include "base/device_options.h"
#include "base/fault.h"
#include "base/names.h"
#include "base/text_file.h"
#include "sim/experiment/resources.h"

namespace reachlab::devices {
namespace {

namespace fs = std::filesystem;

bool isBids(const fs::path& file) { return file.filename().string().ends_with("_motion.tsv"); }
bool isC3d(const fs::path& file) { return file.extension() == ".c3d" || file.extension() == ".C3D"; }

// Where the path ends: the longest that is there, else the first comma.
std::size_t endOfPath(const std::string& argument) {
  for (std::size_t end = argument.size(); end != std::string::npos && end > 0; end = argument.rfind(',', end - 1))
    if (isThere(argument.substr(0, end))) return end;
  return std::min(argument.find(','), argument.size());
}

// Each kind of file has its own keys. One that no file uses is a mistake of the experimenter.
void requireUsed(const ReachColumns& asked, const std::vector<std::string>& files) {
  const bool bids = std::any_of(files.begin(), files.end(), isBids), c3d = std::any_of(files.begin(), files.end(), isC3d);
  const bool table = !std::all_of(files.begin(), files.end(), [](const fs::path& file) { return isBids(file) || isC3d(file); });
  struct Key {
    const char* name;
    bool asked, used;
  };
  std::vector<std::string> known;
  std::string unused;
  for (const Key& key : {Key{"time", !asked.time.empty(), table}, Key{"x", !asked.x.empty(), table}, Key{"y", !asked.y.empty(), table},
                         Key{"z", !asked.z.empty(), table}, Key{"time_unit", !asked.timeUnit.empty(), table},
                         Key{"unit", !asked.unit.empty(), table || c3d}, Key{"rate", asked.rate.has_value(), table || bids},
                         Key{"point", !asked.point.empty(), bids || c3d}, Key{"trial_type", !asked.trialType.empty(), bids}}) {
    if (key.used) known.push_back(key.name);
    else if (key.asked) unused = key.name;
  }
  if (!unused.empty()) throw FaultError(Fault{"device", "replay: " + unused + " is not known for " + files.front(), listOf(known)});
}

}  // namespace

ReachSource reachSourceOf(const std::string& argument) {
  const std::size_t end = endOfPath(argument);
  ReachSource source{argument.substr(0, end), {}};
  DeviceOptions options(argument.substr(end), "device replay");
  ReachColumns& c = source.columns;
  for (const auto& [key, value] :
       {std::pair{"time", &c.time}, {"x", &c.x}, {"y", &c.y}, {"z", &c.z}, {"point", &c.point}, {"trial_type", &c.trialType}})
    *value = options.take(key).value_or("");
  c.unit = options.word("unit", {"", "m", "cm", "mm"});
  c.timeUnit = options.word("time_unit", {"", "s", "ms"});
  constexpr double kNoRate = -1;
  if (const double rate = options.number("rate", kNoRate, 1, 1e6); rate != kNoRate) c.rate = rate;
  options.done();
  return source;
}

std::vector<std::string> reachFiles(const std::string& path) {
  if (isFolder(path)) {
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(path))
      if (entry.path().extension() == ".csv" || isBids(entry.path()) || isC3d(entry.path())) files.push_back(entry.path().string());
    if (files.empty()) throw ResourceError(path + ": no CSV, BIDS motion or C3D files to replay in this folder");
    std::sort(files.begin(), files.end());
    return files;
  }
  if (!isThere(path))
    throw ResourceError(path + ": no such file or folder to replay; the reaches that come with the program are in " +
                        experiment::resourceFolder() + "/reaches");
  return {path};
}

std::vector<RecordedReach> readReaches(const ReachSource& source) {
  std::vector<RecordedReach> reaches;
  const std::vector<std::string> files = reachFiles(source.path);
  requireUsed(source.columns, files);
  for (const std::string& file : files) {
    if (isBids(file)) {
      for (RecordedReach& reach : readBidsReaches(file, source.columns)) reaches.push_back(std::move(reach));
    } else if (!isC3d(file)) {
      reaches.push_back(readReach(file, source.columns));
    } else if (std::optional<RecordedReach> reach = readC3dReach(file, source.columns)) {
      reaches.push_back(*std::move(reach));
    }
  }
  if (reaches.empty())
    throw FaultError(Fault{{}, "has no trial in which the hand was to move and did", "a recording with a reach", FilePlace{source.path}});
  return reaches;
}

}  // namespace reachlab::devices
