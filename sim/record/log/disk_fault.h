#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/system/os.h"

namespace reachlab::record {

/// Throws ResourceError of the system's last error, with action, file, reason and remedy.
[[noreturn]] void failByErrno(std::string_view what, const std::string& path);
/// After a rename or a creation the folder itself must reach the disk, or the name may be lost with the power. Throws ResourceError.
void syncFolderOf(const std::string& path);
/// The reason why nothing more is written beside `path`: its disk has less than `diskReserve` [bytes], or than a twentieth of the disk,
/// left. Empty while there is enough space, or where nothing is known of the disk.
std::string reserveFault(const std::string& path, const os::DiskSpace& disk, std::uint64_t diskReserve);

}  // namespace reachlab::record
