#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "sim/haptics/lateness.h"
#include "sim/haptics/run_sink.h"
#include "base/spsc_queue.h"
#include "sim/haptics/tick_engine.h"
#include "base/triple_buffer.h"

namespace reachlab::haptics {

struct LoopOptions {
  bool virtualClock = false;     // no thread and no waiting: whoever calls `advance` is the haptic thread
  int priority = 80;             // SCHED_FIFO where it is allowed
  std::int64_t spinNs = 50'000;  // the last part of each wait is spun, not slept: removes the wake-up latency for 5 % of a core
};

/// How well the loop kept time. Lateness: from deadline to the start of the tick.
struct LoopReport {
  std::uint64_t ticks = 0;
  double seconds = 0;                                        // [s] from the first tick to the latest
  double rate = 0;                                           // [1/s] achieved
  double latenessP50 = 0, latenessP99 = 0, latenessMax = 0;  // [us]
  LoopFaults faults;
  std::string mode;  // "SCHED_FIFO 80, memory locked", or what was not allowed
};

/// Runs one engine on one device. With the real clock: an own thread at absolute deadlines 1 ms apart; a tick that comes a whole period
/// late or more counts the periods as missed and goes on from there, never in a burst. With the virtual clock: the same tick, called.
/// Construction starts nothing; `start` does. The destructor stops the thread and writes zero force.
class HapticLoop {
 public:
  /// Device and sink (may be null) outlive the loop.
  HapticLoop(std::unique_ptr<TickEngine> engine, HapticDevice& device, RunSink* sink, const LoopOptions& options = {});
  ~HapticLoop();
  HapticLoop(const HapticLoop&) = delete;
  HapticLoop& operator=(const HapticLoop&) = delete;

  void start();
  /// Ends after the tick under way; zero force. Idempotent.
  void stop();
  /// One tick of the virtual clock.
  void advance() noexcept { tick(0, static_cast<std::int64_t>(engine_->state().tick) * kPeriodNs); }

  /// Controlling thread: takes effect at the next tick, in order. False when 16 wait already.
  bool tryCommand(trial::Command command, const trial::PlannedTrial& planned = {}) noexcept {
    return commands_.tryPush({command, planned});
  }
  /// Controlling thread: the newest state, or nullptr when none is newer than the last one taken. Valid until the next call.
  const TickState* takeLatest() noexcept { return snapshots_.takeLatest(); }
  /// Before `start`, after `stop`, or on the virtual clock; `report` also while running (approximate).
  const TickEngine& engine() const noexcept { return *engine_; }
  LoopReport report() const;

  static constexpr std::int64_t kPeriodNs = 1'000'000;

 private:
  struct Order {
    trial::Command command = trial::Command::None;
    trial::PlannedTrial planned;
  };
  void run(const std::stop_token& stop);
  void tick(std::uint32_t missed, std::int64_t measuredNs) noexcept;
  void countLateness(std::int64_t latenessNs, std::uint32_t missed) noexcept;

  std::unique_ptr<TickEngine> engine_;
  HapticDevice& device_;
  RunSink* sink_;
  LoopOptions options_;
  SpscQueue<Order, 16> commands_;
  TripleBuffer<TickState> snapshots_;
  LatenessHistogram lateness_;
  std::atomic<std::uint64_t> ticks_{0}, late_{0}, missed_{0}, longestGapNs_{0}, dropped_{0};
  std::atomic<std::int64_t> firstNs_{0}, lastNs_{0};
  std::string mode_ = "virtual clock";
  std::jthread thread_;
};

}  // namespace reachlab::haptics
