#include "sim/session/backup.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/descriptor.h"
#include "base/text_file.h"
#include "sim/record/log/append_file.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/log.h"
#include "sim/record/log/run_log.h"
#include "sim/record/log/whole_file.h"

namespace reachlab::session {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr std::size_t kHashDigits = 64;
constexpr std::string_view kBetween = "  ";  // hash and file in a line of the list
using record::kLogEnding;

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new()) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) throw ResourceError("SHA-256 cannot be computed here");
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string text() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    std::string hex;
    for (unsigned i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
    return hex;
  }

 private:
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context_;
};

// Reads a file piece by piece. `fromDisk`: not from what the system still has of it in memory, as far as it can be asked.
class Pieces {
 public:
  Pieces(const std::string& path, bool fromDisk) : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    if (file_ < 0) fail("cannot be opened");
    if (fromDisk) (void)::posix_fadvise(file_, 0, 0, POSIX_FADV_DONTNEED);
    buffer_.resize(kPiece);
  }
  std::string_view next() {
    ssize_t count = -1;
    do count = ::read(file_, buffer_.data(), buffer_.size());
    while (count < 0 && errno == EINTR);
    if (count < 0) fail("cannot be read");
    return {buffer_.data(), static_cast<std::size_t>(count)};
  }

 private:
  [[noreturn]] void fail(const char* what) const { throw ResourceError(fmt::format("{}: {}: {}", path_, what, std::strerror(errno))); }
  std::string path_, buffer_;
  os::Descriptor file_;
};

std::string fileHash(const std::string& path, bool fromDisk) {
  Pieces pieces(path, fromDisk);
  Sha256 hash;
  for (std::string_view piece = pieces.next(); !piece.empty(); piece = pieces.next()) hash.add(piece);
  return hash.text();
}

// File by its path in the dataset, to its hash.
using List = std::map<std::string, std::string>;

List readList(const std::string& backup) {
  const std::string path = backup + "/" + kBackupList;
  List list;
  if (!isThere(path)) return list;
  std::istringstream lines(record::readWholeFile(path));
  for (std::string line; std::getline(lines, line);)
    if (line.size() > kHashDigits + kBetween.size()) list[line.substr(kHashDigits + kBetween.size())] = line.substr(0, kHashDigits);
  return list;
}

void writeList(const std::string& backup, const List& list) {
  std::string text;
  for (const auto& [file, hash] : list) text += fmt::format("{}{}{}\n", hash, kBetween, file);
  record::writeFileAtomically(backup + "/" + kBackupList, text);
}

std::string inDataset(const fs::path& file, const fs::path& dataset) { return file.lexically_relative(dataset).generic_string(); }

// "sub-01_ses-01_task-reach" and "_run-03", of a log's or a dataset file's name.
struct RunName {
  std::string stem;
  std::string run;
  bool operator==(const RunName&) const = default;
};
RunName runNameOf(const std::string& file) {
  const std::size_t run = file.find("_run-");
  if (run == std::string::npos) return {};
  const std::size_t end = std::min(file.find('_', run + 1), file.size());
  return {file.substr(0, std::min(file.find("_tracksys-"), run)), file.substr(run, end - run)};
}

// The calls ask for the rights of the user for whom the program works.
bool canBeRead(const fs::path& path, bool folder) {
  return ::faccessat(AT_FDCWD, path.c_str(), folder ? R_OK | X_OK : R_OK, AT_EACCESS) == 0;
}

// Links followed, so that a folder has one name.
fs::path wholePath(const std::string& folder) {
  std::error_code error;
  fs::path whole = fs::weakly_canonical(fs::absolute(folder), error).lexically_normal();
  if (error) whole = fs::absolute(folder).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

bool isInside(const fs::path& folder, const fs::path& outer) {
  std::error_code error;
  for (fs::path at = folder;; at = at.parent_path()) {
    if (at == outer || fs::equivalent(at, outer, error)) return true;
    if (at == at.parent_path()) return false;
  }
}

struct DatasetFiles {
  std::vector<fs::path> files;
  std::string unreadable;  // files and folders, a sentence and a line each
};

// Every file of the dataset that is to be kept, also behind linked folders: not what can be made again from it, not what is being written.
DatasetFiles filesOf(const fs::path& dataset, const fs::path& backup) {
  DatasetFiles found;
  std::error_code error;
  constexpr auto kFollow = fs::directory_options::follow_directory_symlink;
  for (auto entry = fs::recursive_directory_iterator(dataset, kFollow); entry != fs::end(entry); ++entry) {
    const fs::path& path = entry->path();
    const bool folder = entry->is_directory(error);
    // A link to a folder above it would lead round without end.
    const bool left = folder && ((entry.depth() == 0 && path.filename() == "derivatives") || isInside(path.parent_path(), path) ||
                                 fs::equivalent(path, backup, error));
    const bool readable = left || canBeRead(path, folder);
    if (!readable)
      found.unreadable +=
          fmt::format("{}{}: cannot be read: {}", found.unreadable.empty() ? "" : "\n", path.string(), std::strerror(errno));
    if (!folder || left || !readable) entry.disable_recursion_pending();
    if (!folder && readable && entry->is_regular_file(error) && !record::isTemporaryName(path.filename().string()))
      found.files.push_back(path);
  }
  std::sort(found.files.begin(), found.files.end());
  return found;
}

// Copies one file and reads it back. Returns its hash.
std::string copyVerified(const std::string& from, const std::string& to, std::uint64_t& bytes) {
  Pieces pieces(from, false);
  Sha256 hash;
  record::AtomicFile copy(to);
  for (std::string_view piece = pieces.next(); !piece.empty(); piece = pieces.next()) {
    hash.add(piece);
    copy.append(piece);
    bytes += piece.size();
  }
  copy.commit();
  std::string wanted = hash.text();
  if (fileHash(to, true) == wanted) return wanted;
  std::error_code error;
  fs::remove(to, error);
  throw ResourceError(
      fmt::format("{}: reads back with other bytes than were written; the copy was removed: that disk cannot be trusted", to));
}

// The first cells of a table's rows, as they stand.
std::set<std::string> rowsOf(const fs::path& table) {
  std::set<std::string> rows;
  std::istringstream lines(record::readWholeFile(table.string()));
  for (std::string line; std::getline(lines, line);) rows.insert(line.substr(0, line.find('\t')));
  return rows;
}

class Backup {
 public:
  Backup(const std::string& dataset, const std::string& backup)
      : dataset_(wholePath(dataset)), backup_(wholePath(backup)), list_(readList(backup)) {}

  BackupReport run() {
    if (isInside(backup_, dataset_))
      throw FaultError(fileFault(backup_.string(), "lies in the dataset itself", "a folder elsewhere, best on another disk"));
    const auto [files, unreadable] = filesOf(dataset_, backup_);
    std::vector<RunName> left;  // runs that are not copied
    refused_ = unreadable;
    for (const fs::path& file : files) {
      const std::string name = file.filename().string();
      if (!name.ends_with(kLogEnding)) continue;
      const bool open = record::isBeingWritten(file.string());
      const std::string fault = open ? std::string() : faultOf(file);
      if (open) ++report_.pending;
      else if (fault.empty()) ++report_.runs;
      else refuse(fault);
      if (open || !fault.empty()) left.push_back(runNameOf(name));
    }
    for (const fs::path& file : files)
      if (const RunName run = runNameOf(file.filename().string());
          run.run.empty() || std::find(left.begin(), left.end(), run) == left.end())
        keep(file);
    if (report_.copiedFiles > 0) writeList(backup_.string(), list_);
    if (!refused_.empty()) throw ResourceError(refused_);
    return report_;
  }

 private:
  void refuse(const std::string& sentence) { refused_ += (refused_.empty() ? "" : "\n") + sentence; }

  // Why a log that nobody writes is not copied; empty where it is, or is there already.
  std::string faultOf(const fs::path& log) const {
    const fs::path copy = backup_ / inDataset(log, dataset_);
    std::error_code error;
    if (fs::exists(copy, error)) {
      const bool sameSize = fs::file_size(copy, error) == fs::file_size(log, error);
      if (sameSize && (list_.contains(inDataset(log, dataset_)) || fileHash(log.string(), false) == fileHash(copy.string(), true)))
        return {};
      return fmt::format(
          "{}: is there already with other bytes; nothing is overwritten: move it away if the log was recovered since, or choose "
          "another folder",
          copy.string());
    }
    try {
      const record::RunLog run = record::RunLog::open(log.string(), record::LogCheck::Trials);
      if (run.healthy() && run.closed()) return {};
      return fmt::format("{}: its run was not ended in order; repair it with: reach recover {}", log.string(), log.string());
    } catch (const FaultError& fault) {
      return fault.what();
    }
  }

  void keep(const fs::path& file) {
    const std::string name = inDataset(file, dataset_);
    if (name == kBackupList) return;
    const fs::path copy = backup_ / name;
    const bool isLog = name.ends_with(kLogEnding);
    std::error_code error;
    const auto listed = list_.find(name);
    const bool sameSize = fs::exists(copy, error) && fs::file_size(copy, error) == fs::file_size(file, error);
    // A closed log never changes; what is written again may, at the same length.
    if (listed != list_.end() && sameSize && (isLog || fileHash(file.string(), false) == listed->second)) return;
    if (listed == list_.end() && isThere(copy)) {
      std::string there = fileHash(copy.string(), true);
      if (there != fileHash(file.string(), false))
        return refuse(
            fmt::format("{}: is there already with other bytes, and no backup put it there; choose another folder", copy.string()));
      list_[name] = std::move(there);
      ++report_.copiedFiles;
      return;
    }
    const bool ofARun = !runNameOf(file.filename().string()).run.empty();
    if (!ofARun && name.ends_with(".tsv") && isThere(copy)) {
      const std::set<std::string> now = rowsOf(file), kept = rowsOf(copy);
      for (const std::string& row : kept)
        if (!now.contains(row))
          return refuse(
              fmt::format("{}: has a row of {} that {} lacks; it seems to be the backup of another dataset: choose another folder",
                          copy.string(), row, file.string()));
    }
    list_[name] = copyVerified(file.string(), copy.string(), report_.copiedBytes);
    ++report_.copiedFiles;
    // What is safe is said to be, whatever comes after. A table that runs share changes, and must be known then as ours.
    if (isLog || !ofARun) writeList(backup_.string(), list_);
  }

  fs::path dataset_, backup_;
  List list_;
  BackupReport report_;
  std::string refused_;  // a sentence and a line each
};

}  // namespace

BackupReport backUp(const std::string& dataset, const std::string& backup) { return Backup(dataset, backup).run(); }

std::vector<std::string> faultsOfBackup(const std::string& backup) {
  if (!isThere(backup + "/" + kBackupList))
    throw ResourceError(fmt::format("{}/{}: is missing: no backup was made there", backup, kBackupList));
  std::vector<std::string> faults;
  for (const auto& [file, hash] : readList(backup)) {
    const std::string path = backup + "/" + file;
    if (!isThere(path)) {
      faults.push_back(path + ": is missing");
      continue;
    }
    try {
      if (fileHash(path, true) != hash) faults.push_back(path + ": has other bytes than were copied");
    } catch (const ResourceError& fault) {
      faults.emplace_back(fault.what());
    }
  }
  return faults;
}

std::string sha256Of(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return hash.text();
}

std::size_t filesOfBackup(const std::string& backup) { return readList(backup).size(); }

}  // namespace reachlab::session
