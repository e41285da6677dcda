#include "sim/session/session_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/as_number.h"
#include "base/fault.h"
#include "sim/record/configuration/limits.h"
#include "sim/record/log/log.h"
#include "sim/record/log/logs_folder.h"
#include "sim/record/log/run_names.h"

namespace reachlab::session {
namespace {

namespace fs = std::filesystem;
using record::kLogEnding;

// Adds the files of the session in a folder whose names end so. All are then by run number.
void addRuns(std::vector<RunOnDisk>& runs, const fs::path& folder, const SessionPlace& place, std::string_view ending) {
  std::error_code error;
  const std::string prefix = fmt::format("sub-{}_ses-{}_", place.subject, place.session);
  if (!fs::is_directory(folder, error)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(ending)) continue;
    if (const auto run = asNumber<int>(record::labelIn(name, "run")))
      runs.push_back({*run, record::labelIn(name, "task"), entry.path().string()});
  }
  std::stable_sort(runs.begin(), runs.end(), [](const RunOnDisk& a, const RunOnDisk& b) { return a.run < b.run; });
}

}  // namespace

std::string logPath(const SessionPlace& place, const std::string& task, int run) {
  return fmt::format("{}/{}/sub-{}_ses-{}_task-{}_run-{:02}{}", place.data, record::kLogsFolder, place.subject, place.session, task, run,
                     kLogEnding);
}

std::string labelOf(const std::string& name) {
  std::string label;
  for (const char c : name)
    if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) label += c;
  return label.empty() ? "reach" : label;
}

std::vector<RunOnDisk> recordedRuns(const SessionPlace& place) {
  std::vector<RunOnDisk> runs;
  addRuns(runs, fs::path(place.data) / record::kLogsFolder, place, kLogEnding);
  return runs;
}

std::vector<RunOnDisk> takenRuns(const SessionPlace& place) {
  std::vector<RunOnDisk> runs = recordedRuns(place);
  addRuns(runs, fs::path(place.data) / ("sub-" + place.subject) / ("ses-" + place.session) / "motion", place, "");
  return runs;
}

int chooseRun(const SessionPlace& place, std::optional<int> asked) {
  const std::vector<RunOnDisk> runs = takenRuns(place);
  const int free = runs.empty() ? 1 : runs.back().run + 1;
  if (!asked && free <= record::kMaxRun) return free;
  if (!asked) throw FaultError(Fault{"session", fmt::format("{} has {} runs", place.session, record::kMaxRun), "another session"});
  const auto taken = std::find_if(runs.begin(), runs.end(), [&](const RunOnDisk& run) { return run.run == *asked; });
  if (taken != runs.end())
    throw FaultError(Fault{"run",
                           fmt::format("is {}, which subject {}, session {} has already ({}), and nothing is overwritten", *asked,
                                       place.subject, place.session, taken->path),
                           fmt::format("{}, the next free one, or none", free)});
  if (*asked < free)  // `--resume` takes the order of the run numbers for the order in time
    throw FaultError(
        Fault{"run", fmt::format("is {}, but subject {}, session {} already has run {}", *asked, place.subject, place.session, free - 1),
              fmt::format("{} or more, or none", free)});
  return *asked;
}

bool liesInSourcedata(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(path, error);
  const fs::path known = error ? fs::path(path) : whole;
  return std::find(known.begin(), known.end(), record::kLogsFolder) != known.end();
}

record::FolderHold holdDataset(const std::string& data) {
  return {data + "/" + record::kLogsFolder, record::FolderHold::WithoutLocks::Refuse};
}

}  // namespace reachlab::session
