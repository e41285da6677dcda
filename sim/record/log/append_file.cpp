#include "sim/record/log/append_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/system/hold_alone.h"
#include "base/system/os.h"
#include "sim/record/log/disk_fault.h"
#include "sim/record/log/folder_hold.h"

namespace reachlab::record {
namespace {

// The exclusive lock of a log, held as long as the descriptor is open.
void lockExclusively(int descriptor, const std::string& path) {
  if (os::lock(descriptor, LOCK_EX | LOCK_NB)) return;
  if (errno == EWOULDBLOCK)
    throw ResourceError(fmt::format("{}: is being written by another program{}; wait until its run has ended", path, writerOf(path)));
  refuseWithoutLocks(path);
}

}  // namespace

AppendFile AppendFile::create(const std::string& path) {
  makeFolders(std::filesystem::path(path).parent_path().string());
  const int descriptor = os::aboveStandardDescriptors(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0644));
  if (descriptor < 0) failByErrno("cannot be created", path);
  AppendFile file(descriptor, path, 0);
  lockExclusively(descriptor, path);
  syncFolderOf(path);
  return file;
}

void AppendFile::append(std::span<const std::uint8_t> bytes) {
  if (torn_ && ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) failByErrno("cannot be cut to its good part", path_);
  torn_ = false;
  if (!os::writeAll(descriptor_, bytes.data(), bytes.size())) {
    const int fault = errno;
    torn_ = ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0;
    errno = fault;
    failByErrno("cannot be written", path_);
  }
  size_ += bytes.size();
}

void AppendFile::sync() {
  if (!os::syncFile(descriptor_)) failByErrno("cannot be synced to the disk", path_);
  struct stat open {
  }, named{};
  const bool there =
      ::fstat(descriptor_, &open) == 0 && ::stat(path_.c_str(), &named) == 0 && open.st_ino == named.st_ino && open.st_dev == named.st_dev;
  if (!there)
    throw ResourceError(path_ + ": is no longer there: its disk was taken away or it was deleted; put it back before the next run");
}

std::string writerOf(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  std::ifstream locks("/proc/locks");  // NUMBER: FLOCK ADVISORY WRITE PID MAJOR:MINOR:INODE 0 EOF
  for (std::string number, kind, how, what, process, file, rest; locks >> number >> kind >> how >> what >> process >> file;) {
    std::getline(locks, rest);
    if (kind == "FLOCK" && file.ends_with(fmt::format(":{}", status.st_ino))) return fmt::format(" (process {})", process);
  }
  return {};
}

bool isBeingWritten(const std::string& path) {
  const os::Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  return file >= 0 && !os::lock(file, LOCK_SH | LOCK_NB) && errno == EWOULDBLOCK;
}

}  // namespace reachlab::record
