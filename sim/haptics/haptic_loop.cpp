#include "sim/haptics/haptic_loop.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/os.h"

namespace reachlab::haptics {
namespace {

// A counter with one writer.
template <typename T>
void raise(std::atomic<T>& counter, T by) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

}  // namespace

HapticLoop::HapticLoop(std::unique_ptr<TickEngine> engine, HapticDevice& device, RunSink* sink, const LoopOptions& options)
    : engine_(std::move(engine)), device_(device), sink_(sink), options_(options) {
  copyState(engine_->state(), snapshots_.back());
  snapshots_.publish();
}

HapticLoop::~HapticLoop() { stop(); }

void HapticLoop::start() {
  if (options_.virtualClock || thread_.joinable()) return;
  const std::string memory = os::lockMemory();
  std::atomic<bool> ready{false};
  thread_ = std::jthread([this, &ready, memory](const std::stop_token& stopToken) {
    const std::string priority = os::requestRealTime(options_.priority);
    os::requestExactSleep();
    mode_ = fmt::format("{}, {}", priority.empty() ? fmt::format("SCHED_FIFO {}", options_.priority) : priority,
                        memory.empty() ? "memory locked" : memory);
    ready.store(true, std::memory_order_release);
    ready.notify_one();
    run(stopToken);
  });
  ready.wait(false, std::memory_order_acquire);
}

void HapticLoop::stop() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  device_.write({});
}

void HapticLoop::run(const std::stop_token& stop) {
  std::int64_t deadline = os::now() + kPeriodNs;
  firstNs_.store(deadline, std::memory_order_relaxed);
  while (!stop.stop_requested()) {
    os::sleepUntil(deadline - options_.spinNs);
    std::int64_t time = os::now();
    while (time < deadline) time = os::now();
    const std::int64_t lateness = time - deadline;
    const auto missed = static_cast<std::uint32_t>(lateness / kPeriodNs);
    countLateness(lateness, missed);
    tick(missed, time);
    deadline += (static_cast<std::int64_t>(missed) + 1) * kPeriodNs;
  }
}

void HapticLoop::countLateness(std::int64_t latenessNs, std::uint32_t missed) noexcept {
  lateness_.add(latenessNs);
  if (missed == 0) return;
  raise(late_, std::uint64_t{1});
  raise(missed_, std::uint64_t{missed});
  if (const auto gap = static_cast<std::uint64_t>(latenessNs + kPeriodNs); gap > longestGapNs_.load(std::memory_order_relaxed))
    longestGapNs_.store(gap, std::memory_order_relaxed);
}

void HapticLoop::tick(std::uint32_t missed, std::int64_t measuredNs) noexcept {
  TickInput input;
  input.device = device_.read();
  Order order;
  if (commands_.tryPop(order)) {
    input.command = order.command;
    input.planned = order.planned;
  }
  input.missedTicks = missed;
  input.measuredNs = measuredNs;
  engine_->tick(input);
  const TickState& state = engine_->state();
  device_.write(state.deviceForce);
  if (const auto cue = engine_->cue()) device_.cue(*cue);

  LoopFaults& faults = engine_->faults();
  faults.lateTicks = late_.load(std::memory_order_relaxed);
  faults.longestGapNs = longestGapNs_.load(std::memory_order_relaxed);
  if (sink_ != nullptr && !sink_->onTick(state, input.command, missed)) {
    ++faults.droppedRecords;
    raise(dropped_, std::uint64_t{1});
  }
  copyState(state, snapshots_.back());
  snapshots_.publish();
  raise(ticks_, std::uint64_t{1});
  lastNs_.store(measuredNs, std::memory_order_relaxed);
}

LoopReport HapticLoop::report() const {
  LoopReport report;
  report.ticks = ticks_.load(std::memory_order_relaxed);
  report.seconds = static_cast<double>(lastNs_.load(std::memory_order_relaxed) - firstNs_.load(std::memory_order_relaxed)) * 1e-9;
  report.rate = report.seconds > 0 && report.ticks > 1 ? static_cast<double>(report.ticks - 1) / report.seconds : 0;
  report.latenessP50 = lateness_.percentile(0.50) * 1e-3;
  report.latenessP99 = lateness_.percentile(0.99) * 1e-3;
  report.latenessMax = lateness_.max() * 1e-3;
  report.faults.lateTicks = late_.load(std::memory_order_relaxed);
  report.faults.missedTicks = missed_.load(std::memory_order_relaxed);
  report.faults.longestGapNs = longestGapNs_.load(std::memory_order_relaxed);
  report.faults.droppedRecords = dropped_.load(std::memory_order_relaxed);
  report.mode = mode_;
  return report;
}

}  // namespace reachlab::haptics
