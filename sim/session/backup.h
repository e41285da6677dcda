#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace reachlab::session {

/// The list of what is in a backup with each file's SHA-256, as sha256sum writes and checks it: `cd BACKUP && sha256sum -c
/// sourcedata/sha256sums.txt`.
inline constexpr const char* kBackupList = "sourcedata/sha256sums.txt";

struct BackupReport {
  std::size_t runs = 0;         // of the dataset that are closed, all of them now in the backup
  std::size_t copiedFiles = 0;  // now; every one read back from the disk and found equal
  std::uint64_t copiedBytes = 0;
  std::size_t pending = 0;  // runs that are still being recorded
};

/// Brings a second data folder up to date: every closed run that is not in it yet is copied, its log and its files of the dataset, and the tables
/// that the runs share; each copy is read back from the disk and its hash compared before its line goes into the list. A log that is there with
/// other bytes, or that was not ended in order, is left with its files and named when all others are copied: nothing is overwritten. Throws
/// ResourceError, FaultError (the backup is the dataset itself, or lies in it); what was copied stays good.
BackupReport backUp(const std::string& dataset, const std::string& backup);

/// What is wrong with a backup, a sentence a file: missing, or other bytes than were copied. Reads every byte of it. Throws ResourceError when
/// there is no list.
std::vector<std::string> faultsOfBackup(const std::string& backup);
/// Files in its list.
std::size_t filesOfBackup(const std::string& backup);

}  // namespace reachlab::session
