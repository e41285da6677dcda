#pragma once
#include <cstdint>
#include <string>

namespace reachlab {

inline constexpr std::uintmax_t kMostTextBytes = 16u << 20;

/// Reads a whole file of at most `mostBytes`. Throws FaultError naming the file and the operating system's reason.
std::string readTextFile(const std::string& file, std::uintmax_t mostBytes = kMostTextBytes);

}  // namespace reachlab
