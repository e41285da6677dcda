#pragma once
#include <cstdint>
#include <memory>

#include "sim/haptics/leavable_thread.h"
#include "sim/haptics/loop_core.h"

namespace reachlab::haptics {

/// Runs one engine on one device. The clock is one of three:
///   real time      an own thread at absolute deadlines 1 ms apart; a tick that comes a whole period late or more counts the periods as
///                  missed and continues from there, never in a burst;
///   virtual        the same tick, called by `advance`; nothing waits;
///   the device's   DeviceInfo::drivesClock: the device calls at its rate from its own thread; periods are counted on the monotonic
///                  clock as in real time, and a call that comes before half a period has passed repeats the last force.
/// A watch in the tick (device_watch.h) and a watchdog thread guard a device that renders force. If no tick is completed for 20 ms while
/// force is on, the device is told zero by its second path and the fault is latched. The tick never waits for the watchdog. A device call
/// that hangs is left behind: `stop` gives it kPatienceMs and returns without it. The thread of that call then never touches engine, sink
/// or anything of ours again. Construction starts nothing, `start` does. The destructor stops and writes zero force.
class HapticLoop {
 public:
  /// The sink (may be null) outlives the loop.
  HapticLoop(std::unique_ptr<TickEngine> engine, std::shared_ptr<HapticDevice> device, RunSink* sink, const LoopOptions& options = {});
  ~HapticLoop();

  /// Throws ResourceError from a device that drives the clock.
  void start();
  /// Ends after the tick under way with zero force. Idempotent. Whatever the device does, all waits together last kPatienceMs +
  /// kLastWordMs at most.
  void stop();
  /// One tick of the virtual clock.
  void advance() noexcept;

  /// Controlling thread: takes effect at the next tick, in order. False when 16 wait already.
  bool tryCommand(trial::Command command, const trial::PlannedTrial& planned = {}) noexcept {
    return core_->commands.tryPush({command, planned});
  }
  /// Controlling thread: the newest state, or nullptr if it was taken before. Valid until the next call.
  const TickState* takeLatest() noexcept { return core_->snapshots.takeLatest(); }
  /// Before `start`, after `stop` (unless `hangs`), or on the virtual clock. `report` may also be called while running (approximate).
  const TickEngine& engine() const noexcept { return *core_->engine; }
  LoopReport report() const { return reportOf(*core_); }

  /// Any thread: the latched fault, or DeviceFault::None.
  DeviceFault fault() const noexcept { return latched().fault; }
  /// The same, with the hand whose device it is of.
  LatchedFault latched() const noexcept { return core_->latched.load(std::memory_order_acquire); }
  /// Controlling thread, once the loop `hangs`: stops it, and ends the trial that is under way as one that lost its device.
  void endWithoutDevice();
  /// Controlling thread, after the experimenter has removed the cause. Takes effect at the next tick.
  void resetFault() noexcept { core_->resetAsked.store(true, std::memory_order_release); }
  /// Any thread: no tick has come for kHangNs since the watchdog fired, or a device call was left behind. The trial will not end.
  bool hangs() const noexcept;

  static constexpr std::int64_t kPeriodNs = LoopCore::kPeriodNs;
  static constexpr int kPatienceMs = 300;  // for the tick, or the device's clock, to end
  static constexpr int kLastWordMs = 100;  // for `stopForce` and the watchdog after that
  static constexpr std::int64_t kHangNs = 500'000'000;

 private:
  LoopOptions options_;
  std::shared_ptr<LoopCore> core_;  // shared with a thread that a hanging device call may hold for ever
  LeavableThread thread_, watchdog_;
  bool started_ = false, stopped_ = false;
};

}  // namespace reachlab::haptics
