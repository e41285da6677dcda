#include "sim/record/log/folder_hold.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/system/hold_alone.h"
#include "base/system/os.h"
#include "sim/record/log/disk_fault.h"

namespace reachlab::record {

void makeFolders(const std::string& path) {
  if (path.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error) return;
  errno = error.value();
  failByErrno("cannot be made", path);
}

void refuseWithoutLocks(const std::string& path) {
  throw ResourceError(
      fmt::format("{}: cannot be locked against a second program: {}; choose a folder on a disk with locks", path, std::strerror(errno)));
}

FolderHold::FolderHold(const std::string& folder, WithoutLocks otherwise) {
  makeFolders(folder);
  descriptor_ = os::Descriptor(os::aboveStandardDescriptors(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)));
  const bool refuse = otherwise == WithoutLocks::Refuse;
  if (descriptor_ < 0 && refuse) throw ResourceError(fmt::format("{}: cannot be opened: {}", folder, std::strerror(errno)));
  if (descriptor_ >= 0 && !os::lock(descriptor_, LOCK_EX) && refuse) refuseWithoutLocks(folder);
}

}  // namespace reachlab::record
