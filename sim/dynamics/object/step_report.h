#pragma once
#include <cstdint>

namespace reachlab::dynamics {

/// The report of a method on its step.
struct StepReport {
  std::uint64_t rhs = 0;  // right-hand sides, added up
  double error = 0;       // local error estimate of the step, in units of each number's scale
};

/// The largest number of right-hand sides in one tick. Beyond it the step is Capped and the force is zero.
inline constexpr int kMaxRhsPerTick = 1000;

}  // namespace reachlab::dynamics
