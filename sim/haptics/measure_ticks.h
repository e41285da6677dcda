#pragma once
#include <cstdint>

#include "sim/haptics/tick_engine.h"

namespace reachlab::haptics {

/// Computation time of one tick on the monotonic clock, from the device's sample to the force for the device, without the device itself.
/// Each number includes one look at the clock, some 20 ns. These are numbers of this machine: reported, never judged.
struct TickTiming {
  std::uint64_t ticks = 0;
  std::uint64_t trials = 0;                    // that were queued: 1, unless the object met an edge, where the next trial begins
  double p50 = 0, p99 = 0, p999 = 0, max = 0;  // [ns]
  double middle = 0;                           // [ns] mean of the middle half: finer than what the clock counts in, for comparisons
  double clock = 0;                            // [ns] median of two looks at the clock with nothing between
  std::uint64_t allocations = 0;               // of memory in all ticks together, if they were counted
};

/// Runs `ticks` ticks of a trial that does not end. The hand swings about the start along the path to the target by 10 % of the chord at
/// 1 Hz, or by 1 cm if start and target are one place. Throws like TickEngine's constructor. Not real time: ticks follow one another at
/// once. `countAllocations` gives the thread's allocations so far. null: not counted.
TickTiming measureTicks(const experiment::Experiment& experiment, std::uint64_t ticks = 1'000'000,
                        std::uint64_t (*countAllocations)() noexcept = nullptr);

}  // namespace reachlab::haptics
