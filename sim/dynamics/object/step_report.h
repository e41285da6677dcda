#pragma once
#include <cstdint>

namespace reachlab::dynamics {

/// What a method tells of its step.
struct StepReport {
  std::uint64_t rhs = 0;  // right-hand sides, added up
  double error = 0;       // local error estimate of the step, in units of each number's scale
};

/// Right-hand sides that one tick may cost; beyond it the step is Capped and the force zero.
inline constexpr int kMaxRhsPerTick = 1000;

}  // namespace reachlab::dynamics
