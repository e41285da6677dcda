#pragma once
#include <algorithm>

namespace reachlab {

/// The longest gap between two samples of a hand that is bridged [s]: 0.1 s, or two sampling intervals. With a longer gap, a recorded reach is
/// not replayed and a trial is left out of the analysis.
constexpr double longestGap(double interval) { return std::max(0.1, 2 * interval); }

}  // namespace reachlab
