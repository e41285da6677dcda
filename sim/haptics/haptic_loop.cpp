#include "sim/haptics/haptic_loop.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>

#include "base/system/os.h"
#include "sim/haptics/watchdog.h"

namespace reachlab::haptics {
namespace {

constexpr std::int64_t kLookNs = 5'000'000;  // of the watchdog

std::string describeRights(const std::string& priority, int wanted, const std::string& memory) {
  return fmt::format("{}, {}", priority.empty() ? fmt::format("SCHED_FIFO {}", wanted) : priority,
                     memory.empty() ? "memory locked" : memory);
}

void runOnOwnClock(LoopCore& core, const LoopOptions& options) {
  constexpr std::int64_t kPeriodNs = LoopCore::kPeriodNs;
  LoopClock computers;
  LoopClock& clock = options.clock ? *options.clock : computers;
  std::int64_t deadline = clock.now() + kPeriodNs;
  core.firstNs.store(deadline, std::memory_order_relaxed);
  while (!core.stopping.load(std::memory_order_acquire)) {
    clock.sleepUntil(deadline - options.spinNs);
    std::int64_t time = clock.now();
    while (time < deadline) time = clock.now();
    const std::int64_t lateness = time - deadline;
    const auto missed = static_cast<std::uint32_t>(lateness / kPeriodNs);
    core.countLateness(lateness, missed);
    if (!core.tick(missed, time)) return;
    deadline += (static_cast<std::int64_t>(missed) + 1) * kPeriodNs;
  }
  core.writeLastZero();
}

void watchLoop(LoopCore& core) {
  while (!core.stopping.load(std::memory_order_acquire)) {
    const std::int64_t now = os::now();
    const DeviceFault fault = judgeLoop(
        {now, core.completedNs.load(std::memory_order_acquire), core.forceOn.load(std::memory_order_relaxed), core.info.drivesClock});
    if (fault != DeviceFault::None) {
      core.latch(fault);
      if (core.silentSinceNs.load(std::memory_order_relaxed) == 0) core.silentSinceNs.store(now, std::memory_order_release);
      core.device->stopForce();
    } else {
      core.silentSinceNs.store(0, std::memory_order_release);
    }
    os::sleepUntil(now + kLookNs);
  }
}

}  // namespace

HapticLoop::HapticLoop(std::unique_ptr<TickEngine> engine, std::shared_ptr<HapticDevice> device, RunSink* sink, const LoopOptions& options)
    : options_(options), core_(std::make_shared<LoopCore>(std::move(engine), std::move(device), sink)) {}

HapticLoop::~HapticLoop() { stop(); }

void HapticLoop::start() {
  if (options_.virtualClock || started_) return;
  started_ = true;
  const std::string memory = os::lockMemory();
  if (core_->info.drivesClock) {
    core_->mode = fmt::format("the device's clock, {}", memory.empty() ? "memory locked" : memory);
    core_->realTime = true;
    core_->completedNs.store(os::now(), std::memory_order_release);  // the watchdog waits for the first call from here
    core_->device->startClock([](void* core) noexcept { static_cast<LoopCore*>(core)->tickOfDevice(); }, core_.get());
  } else {
    auto ready = std::make_shared<std::atomic<bool>>(false);
    thread_ = LeavableThread([core = core_, options = options_, ready, memory] {
      const std::string refused = os::requestRealTime(options.priority);
      core->realTime = refused.empty();
      core->mode = describeRights(refused, options.priority, memory);
      os::requestExactSleep();
      ready->store(true, std::memory_order_release);
      ready->notify_one();
      runOnOwnClock(*core, options);
    });
    ready->wait(false, std::memory_order_acquire);
  }
  if (core_->anyRendersForce)
    watchdog_ = LeavableThread([core = core_, priority = options_.priority] {
      os::requestRealTime(priority);
      watchLoop(*core);
    });
}

void HapticLoop::advance() noexcept { core_->tick(0, static_cast<std::int64_t>(core_->engine->state().tick) * kPeriodNs); }

// A device that hangs is left behind with nothing of ours in its hands. All waits here end at the same two moments.
void HapticLoop::stop() {
  if (stopped_) return;
  stopped_ = true;
  core_->stopping.store(true, std::memory_order_release);
  if (!started_) {
    core_->writeZero();
    return;
  }
  const auto patience = std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatienceMs);
  const auto lastMoment = patience + std::chrono::milliseconds(kLastWordMs);
  if (core_->info.drivesClock)
    thread_ = LeavableThread([core = core_] {
      core->device->stopClock();
      core->writeZero();
    });
  if (!thread_.joinUntil(patience)) {
    core_->latch(DeviceFault::Stalled);
    while (!core_->abandon()) std::this_thread::yield();
    core_->abandoned.store(true, std::memory_order_release);
    LeavableThread lastWord([core = core_] { core->device->stopForce(); });  // it, too, may hang
    lastWord.joinUntil(lastMoment);
    thread_.leave();
  }
  if (!watchdog_.joinUntil(lastMoment)) watchdog_.leave();
}

void HapticLoop::endWithoutDevice() {
  stop();
  core_->endWithoutDevice(os::now());
}

bool HapticLoop::hangs() const noexcept {
  const std::int64_t since = core_->silentSinceNs.load(std::memory_order_acquire);
  return (since != 0 && os::now() - since > kHangNs) || core_->abandoned.load(std::memory_order_acquire);
}

}  // namespace reachlab::haptics
