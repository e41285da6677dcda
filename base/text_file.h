#pragma once
#include <cstdint>
#include <string>

namespace reachlab {

inline constexpr std::uintmax_t kMostTextBytes = 16u << 20;

/// These questions follow links and throw nothing. The answer is false if the system cannot tell it.
bool isThere(const std::string& path);
bool isFile(const std::string& path);
bool isFolder(const std::string& path);
/// Returns the path of the file of this name beside `file` if there is one, else the name as it is.
std::string besideFile(const std::string& file, const std::string& name);

/// Reads a whole file of at most `mostBytes`. Throws FaultError naming the file and the operating system's reason.
std::string readTextFile(const std::string& file, std::uintmax_t mostBytes = kMostTextBytes);

/// Passes if the path exists or does not exist. Throws ResourceError naming the system's reason if that cannot be known (no permission to
/// search a folder, links in a loop). Call it before you say that something is not there.
void requireSearchable(const std::string& path);

}  // namespace reachlab
