#pragma once

namespace reachlab::constraints::narrow {

// A stretch is narrow on which a formula bends kMuch times more than usual and that is shorter than a tick's way.
inline constexpr double kMuch = 30;
inline constexpr double kWay = 2e-3;  // [m]

}  // namespace reachlab::constraints::narrow
