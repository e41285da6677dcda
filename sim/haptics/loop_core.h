#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/system/os.h"
#include "base/system/spsc_queue.h"
#include "base/system/triple_buffer.h"
#include "base/ticks.h"
#include "sim/haptics/device_watch.h"
#include "sim/haptics/lateness.h"
#include "sim/haptics/run_sink.h"
#include "sim/haptics/tick_engine.h"

namespace reachlab::haptics {

/// The monotonic clock by which a loop in real time keeps its deadlines. Usually the computer's clock. A test uses a clock that it
/// controls. Called from the haptic thread. Neither allocates nor throws.
class LoopClock {
 public:
  virtual ~LoopClock() = default;
  virtual std::int64_t now() noexcept { return os::now(); }  // [ns]
  virtual void sleepUntil(std::int64_t deadlineNs) noexcept { os::sleepUntil(deadlineNs); }
};

struct LoopOptions {
  bool virtualClock = false;         // no thread and no waiting: whoever calls `advance` is the haptic thread
  int priority = 80;                 // SCHED_FIFO where it is allowed
  std::shared_ptr<LoopClock> clock;  // of real time; null: the computer's
  std::int64_t spinNs = 50'000;      // the last part of each wait is spun, not slept: removes the wake-up latency for 5 % of a core
};

/// How well the loop kept time. Lateness: from deadline to the start of the tick.
struct LoopReport {
  std::uint64_t ticks = 0;
  double seconds = 0;                                        // [s] from the first tick to the latest
  double rate = 0;                                           // [1/s] achieved
  double latenessP50 = 0, latenessP99 = 0, latenessMax = 0;  // [us]
  LoopFaults faults;
  std::string mode;       // "SCHED_FIFO 80, memory locked", or what was not allowed
  bool realTime = false;  // the loop runs at real-time priority, or by the device's own clock
};

/// The first fault since the start or the latest reset.
struct LatchedFault {
  DeviceFault fault = DeviceFault::None;
  std::uint8_t hand = 0;  // whose device has it, from 0
};
static_assert(std::atomic<LatchedFault>::is_always_lock_free);

/// The data of the haptic thread. Plain members with one writer each. Every thread that may still run in it keeps it alive.
struct LoopCore {
  static constexpr std::int64_t kPeriodNs = kTickNs;

  struct Order {
    trial::Command command = trial::Command::None;
    trial::PlannedTrial planned;
  };
  /// The place of the haptic thread. `abandon` takes it from Idle or InDevice to Abandoned. If the device's call returns after that, the
  /// thread leaves without touching anything.
  enum class Where : std::uint8_t { Idle, InDevice, Computing, Abandoned };

  LoopCore(std::unique_ptr<TickEngine> engine, std::shared_ptr<HapticDevice> device, RunSink* sink);

  /// One tick. False: the loop was abandoned while the device held it, and nothing may be touched any more.
  bool tick(std::uint32_t missed, std::int64_t measuredNs) noexcept;
  /// To every device.
  void writeZero() noexcept;
  /// At the end of the haptic thread.
  void writeLastZero() noexcept;
  /// Once the haptic thread will never touch anything here again: ends the trial that is under way, as one that lost its device.
  void endWithoutDevice(std::int64_t nowNs) noexcept;
  void countLateness(std::int64_t latenessNs, std::uint32_t missed) noexcept;
  /// One call of a device that drives the clock. It makes no tick if less than half a period has passed since the last tick.
  void tickOfDevice() noexcept;
  /// Controlling thread: true once the haptic thread will never touch anything here again. False: it computes just now, so ask again.
  bool abandon() noexcept;
  /// Any thread: the first fault stays. `hand`: whose device it is of, from 0.
  void latch(DeviceFault fault, int hand = 0) noexcept;
  /// Any thread: a device's fault is latched.
  bool hasFault() const noexcept { return latched.load(std::memory_order_acquire).fault != DeviceFault::None; }

  std::unique_ptr<TickEngine> engine;
  std::shared_ptr<HapticDevice> device;
  DeviceInfo info;
  RunSink* sink;
  struct Hand {
    HapticDevice* device;  // which `device` keeps
    bool rendersForce;
    DeviceWatch watch;
  };
  std::vector<Hand> hands;  // the first hand at index 0
  TickInput input;
  bool anyRendersForce = false;
  SpscQueue<Order, 16> commands;
  TripleBuffer<TickState> snapshots;
  LatenessHistogram lateness;
  std::atomic<std::uint64_t> ticks{0}, late{0}, missedTicks{0}, longestGapNs{0}, dropped{0};
  std::atomic<std::int64_t> firstNs{0}, lastNs{0};
  std::atomic<std::int64_t> completedNs{0};  // when the latest tick was completed, for the watchdog
  std::atomic<bool> forceOn{false};          // a trial is engaged
  std::atomic<LatchedFault> latched{};
  std::atomic<bool> resetAsked{false};
  std::atomic<Where> where{Where::Idle};
  std::atomic<bool> stopping{false};
  std::atomic<std::int64_t> silentSinceNs{0};  // when the watchdog first saw no tick, 0 while ticks come
  std::atomic<bool> abandoned{false};          // `stop` has left a device call behind
  std::int64_t deadlineNs = 0;                 // of the next tick of a clock that the device drives
  std::string mode = "virtual clock";
  bool realTime = false;

 private:
  bool enterDevice(Where from) noexcept;
  bool leaveDevice() noexcept;
  void writeForces() noexcept;
  void acceptReset() noexcept;
  struct Stages;  // of a tick (tick_order.h)
};

LoopReport reportOf(const LoopCore& core);

}  // namespace reachlab::haptics
