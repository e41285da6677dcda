#include "sim/record/log/disk_reserve.h"

#include <fmt/format.h>

#include <algorithm>

namespace reachlab::record {

std::string reserveFault(const std::string& path, const os::DiskSpace& disk, std::uint64_t diskReserve) {
  const std::uint64_t reserve = std::min(diskReserve, disk.size / 20);
  if (disk.size == 0 || disk.free >= reserve) return {};
  return fmt::format(
      "{}: {:.3g} MB are left on the disk, less than the {:.3g} MB that are kept free; what was recorded is safe: free space, "
      "keep less free, or choose another folder",
      path, static_cast<double>(disk.free) * 1e-6, static_cast<double>(reserve) * 1e-6);
}

}  // namespace reachlab::record
