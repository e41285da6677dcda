#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace reachlab::constraints::narrow {

// A stretch is narrow on which a formula bends kMuch times more than usual and that is shorter than a tick's way.
inline constexpr double kMuch = 30;
inline constexpr double kWay = 2e-3;  // [m]
inline constexpr int kBoxes = 20000;  // boxes of a search on one line, as in findRoots

/// The median of `all`, which is not empty and is reordered.
inline double median(std::vector<double>& all) {
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

}  // namespace reachlab::constraints::narrow
