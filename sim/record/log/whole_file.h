#pragma once
#include <cstdint>
#include <string>

namespace reachlab::record {

/// The whole file. Throws ResourceError (also for a pipe or a device, which might never end), FaultError beyond kMaxBytesOfAFile.
inline constexpr std::int64_t kMaxBytesOfAFile = 1ll << 30;
std::string readWholeFile(const std::string& path);

}  // namespace reachlab::record
