#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/record/log/folder_hold.h"

namespace reachlab::session {

/// A dataset's folder and the labels of one session in it.
struct SessionPlace {
  std::string data = "./data";
  std::string subject = "01", session = "01";
  bool operator==(const SessionPlace&) const = default;
};

/// A log of a session.
struct RunOnDisk {
  int run = 0;
  std::string task, path;
};

/// `…/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach`.
std::string logPath(const SessionPlace& place, const std::string& task, int run);
/// A BIDS label of a name: its letters and digits ("chain-moderate" gives "chainmoderate").
std::string labelOf(const std::string& name);
/// Whether the path is a dataset's folder of logs, or lies in such a folder. It is for logs alone.
bool liesInSourcedata(const std::string& path);
/// The session's logs, by run number. Empty when there are no logs.
std::vector<RunOnDisk> recordedRuns(const SessionPlace& place);
/// The same with the session's BIDS files (`motion/…_run-01_…`) behind its logs: their numbers are taken, wherever their logs are.
std::vector<RunOnDisk> takenRuns(const SessionPlace& place);
/// The next free run number, or `asked`. Throws FaultError with a proposal when that number is taken: nothing is overwritten.
int chooseRun(const SessionPlace& place, std::optional<int> asked);

/// Locks a dataset against other programs that record into it, while a run number is taken or a shared table is rewritten. Makes the folder
/// of the logs if it is missing. Throws ResourceError, also where a file system has no locks.
record::FolderHold holdDataset(const std::string& data);

}  // namespace reachlab::session
