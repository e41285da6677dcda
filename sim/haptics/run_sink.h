#pragma once
#include <cstdint>

#include "sim/haptics/tick_state.h"
#include "sim/trial/planned_trial.h"

namespace reachlab::haptics {

/// The receiver of a run's ticks, usually the recorder, as haptic loop and conductor see it. Without a sink no tick is kept. A sink that only
/// watches has nothing to announce, await or close.
class RunSink {
 public:
  virtual ~RunSink() = default;

  /// Haptic thread (virtual clock: the controlling thread), every tick. Must not wait in real time, allocate or throw. False: the tick
  /// is lost, and counted.
  virtual bool onTick(const TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept = 0;
  /// `onTick` looks at the inner masses and the energy only at multiples of this number of ticks. 0: never.
  virtual std::uint32_t massesEvery() const noexcept { return 1; }
  /// Controlling thread, before a trial is queued. May throw ResourceError, as all below.
  virtual void announce(std::int32_t /*trial*/, const trial::PlannedTrial& /*planned*/) {}
  /// Controlling thread, after a trial has ended: returns once its record is safe on the disk.
  virtual void awaitTrial(std::int32_t /*trial*/) {}
  /// Ends the record in order.
  virtual void close() {}
};

}  // namespace reachlab::haptics
