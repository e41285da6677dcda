#pragma once
#include <cstddef>

/// Limits that a log's reader accepts and its writer keeps.
namespace reachlab::record {

inline constexpr int kMaxRun = 99'999;
/// Of a label: file names join three of them, and have at most 255 bytes.
inline constexpr std::size_t kMaxLabelLength = 60;

}  // namespace reachlab::record
