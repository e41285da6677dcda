#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/record/log/logs_folder.h"

namespace reachlab::session {

/// The list of the files in a backup with their SHA-256, in the format of sha256sum: `cd BACKUP && sha256sum -c sourcedata/sha256sums.txt`.
inline const std::string kBackupList = std::string(record::kLogsFolder) + "/sha256sums.txt";

struct BackupReport {
  std::size_t runs = 0;         // closed runs of the dataset, all of them now in the backup
  std::size_t copiedFiles = 0;  // now, each read back from the disk and found equal
  std::uint64_t copiedBytes = 0;
  std::size_t pending = 0;  // runs that are still being recorded
};

/// Brings a second data folder up to date. Every closed run that it lacks is copied: its log, its files of the dataset, and the tables that
/// the runs share. Each copy is read back from the disk and its hash compared before its line enters the list. A log that
/// has other bytes there or was not ended in order, and any file that has other bytes there and is in no list, are named after all other
/// copies and not overwritten. Links to folders are followed. Throws ResourceError, and FaultError
/// where the backup is the dataset itself or lies in it. Finished copies stay good.
BackupReport backUp(const std::string& dataset, const std::string& backup);

/// The faults of a backup, one sentence per file: the file is missing or has other bytes. Reads every byte. Throws ResourceError when there
/// is no list.
std::vector<std::string> faultsOfBackup(const std::string& backup);
/// SHA-256 of a text, in hexadecimal digits.
std::string sha256Of(std::string_view text);
/// Files in its list.
std::size_t filesOfBackup(const std::string& backup);

}  // namespace reachlab::session
