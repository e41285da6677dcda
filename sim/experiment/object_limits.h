#pragma once

namespace reachlab::experiment {

inline constexpr int kMaxMasses = 512;
inline constexpr int kMaxHands = 8;  // on one object

}  // namespace reachlab::experiment
