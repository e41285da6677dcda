#pragma once
#include <cstdint>

#include "sim/haptics/tick_engine.h"

namespace reachlab::haptics {

/// What one tick costs, from the device's sample to the force for the device, without the device itself, as the monotonic clock sees it
/// (one look at the clock, some 20 ns, is in each). Wall-clock numbers of this machine: to be reported, never judged.
struct TickTiming {
  std::uint64_t ticks = 0;
  std::uint64_t trials = 0;                    // that were put up: 1, unless the object met an edge, where the next one begins
  double p50 = 0, p99 = 0, p999 = 0, max = 0;  // [ns]
  double middle = 0;                           // [ns] mean of the middle half: finer than what the clock counts in, for comparisons
  double clock = 0;                            // [ns] median of two looks at the clock with nothing between
  std::uint64_t allocations = 0;               // of memory in all ticks together, if they were counted
};

/// Runs `ticks` ticks of a trial that does not end, with a hand that swings about the start along the way to the target, 10 % of the
/// chord at 1 Hz (1 cm where start and target are one place). Throws what TickEngine's constructor throws. Not real time: ticks follow
/// one another at once. `countAllocations` gives the thread's allocations so far; null: not counted.
TickTiming measureTicks(const experiment::Experiment& experiment, std::uint64_t ticks = 1'000'000,
                        std::uint64_t (*countAllocations)() noexcept = nullptr);

}  // namespace reachlab::haptics
