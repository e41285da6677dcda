#pragma once
#include <string>
#include <string_view>

namespace reachlab::record {

/// Throws ResourceError of the system's last error, with action, file, reason and remedy.
[[noreturn]] void failByErrno(std::string_view what, const std::string& path);
/// After a rename or a creation the folder itself must reach the disk, or the name may be lost with the power. Throws ResourceError.
void syncFolderOf(const std::string& path);

}  // namespace reachlab::record
