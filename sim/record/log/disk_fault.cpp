#include "sim/record/log/disk_fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.h"

namespace reachlab::record {

void failByErrno(std::string_view what, const std::string& path) {
  const int fault = errno;
  std::string_view remedy = "check the folder and its permissions";
  if (fault == EFBIG)
    remedy = "its disk or a limit of this process (ulimit -f) allows no larger file: choose another disk or raise the limit";
  if (fault == ENOSPC || fault == EDQUOT) remedy = "free space on the disk or choose another folder";
  if (fault == EACCES || fault == EPERM) remedy = "choose a folder that can be written";
  if (fault == EROFS) remedy = "what is on it is safe: choose a folder on another disk, or mount it for writing";
  if (fault == EEXIST) remedy = "nothing is overwritten: choose another name";
  if (fault == EIO || fault == ENODEV || fault == ENXIO) remedy = "the disk has gone: what was synced before is safe on it";
  throw ResourceError(fmt::format("{}: {}: {}; {}", path, what, std::strerror(fault), remedy));
}

void syncFolderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  // Some network file systems have no such thing and say EINVAL: there it is theirs to keep.
  if (!os::syncFolder(folder.empty() ? "." : folder) && errno != EINVAL) failByErrno("its name cannot be synced to the disk", path);
}

std::string reserveFault(const std::string& path, const os::DiskSpace& disk, std::uint64_t diskReserve) {
  const std::uint64_t reserve = std::min(diskReserve, disk.size / 20);
  if (disk.size == 0 || disk.free >= reserve) return {};
  return fmt::format(
      "{}: {:.3g} MB are left on the disk, less than the {:.3g} MB that are kept free; what was recorded is safe: free space, "
      "keep less free, or choose another folder",
      path, static_cast<double>(disk.free) * 1e-6, static_cast<double>(reserve) * 1e-6);
}

}  // namespace reachlab::record
