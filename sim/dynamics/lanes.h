#pragma once

namespace reachlab::dynamics {

/// Four doubles that the compiler keeps in vector registers (split where the processor has narrower ones).
using Lanes = double __attribute__((vector_size(32)));
inline constexpr int kLanes = 4;

inline Lanes broadcast(double value) noexcept { return Lanes{value, value, value, value}; }
constexpr int lanesFor(int count) noexcept { return (count + kLanes - 1) / kLanes; }
inline bool allFinite(const Lanes& sum) noexcept { return (sum[0] + sum[1]) + (sum[2] + sum[3]) == 0; }

}  // namespace reachlab::dynamics
