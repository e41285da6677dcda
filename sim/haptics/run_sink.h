#pragma once
#include <cstdint>
#include <string>

#include "sim/haptics/tick_state.h"
#include "sim/trial/planned_trial.h"

namespace reachlab::haptics {

/// Where a run's ticks go: the history unit, behind what the haptic loop and the conductor need of it. Without one nothing is kept.
class RunSink {
 public:
  virtual ~RunSink() = default;

  /// Haptic thread (virtual clock: the controlling thread), every tick; must not wait in real time, allocate or throw. False: the tick
  /// is lost, and counted.
  virtual bool onTick(const TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept = 0;
  /// Every how many ticks (at their multiples) `onTick` looks at masses other than the first and the last, and at the energy;
  /// 0: never.
  virtual std::uint32_t massesEvery() const noexcept { return 1; }
  /// Controlling thread, before a trial is put up. May throw ResourceError, as all below.
  virtual void announce(std::int32_t trial, const trial::PlannedTrial& planned) = 0;
  /// Controlling thread, after a trial has ended: returns once its record is safe on the disk.
  virtual void awaitTrial(std::int32_t trial) = 0;
  /// Ends the record in order.
  virtual void close() = 0;
};

}  // namespace reachlab::haptics
