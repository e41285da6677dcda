#pragma once
#include <cstdint>
#include <string>

#include "base/system/os.h"

namespace reachlab::record {

/// The reason why nothing more is written beside `path`: its disk has less than `diskReserve` [bytes], or than a twentieth of the disk,
/// left. Empty while there is enough space, or where nothing is known of the disk.
std::string reserveFault(const std::string& path, const os::DiskSpace& disk, std::uint64_t diskReserve);

}  // namespace reachlab::record
