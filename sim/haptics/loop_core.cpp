#include "sim/haptics/loop_core.h"

#include <algorithm>
#include <new>

#include "sim/haptics/tick_order.h"

namespace reachlab::haptics {
namespace {

// A counter with one writer.
template <typename T>
void raise(std::atomic<T>& counter, T by) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

// A trial is under way, or a stylus is held against its weight.
bool forceActs(const TickState& state) noexcept {
  const auto isPushed = [](const HandState& hand) { return !(hand.deviceForce == Vec3{}); };
  return trial::isEngaged(state.phase) || std::any_of(state.hands.begin(), state.hands.begin() + state.handCount, isPushed);
}

}  // namespace

LoopCore::LoopCore(std::unique_ptr<TickEngine> theEngine, std::shared_ptr<HapticDevice> theDevice, RunSink* theSink)
    : engine(std::move(theEngine)), device(std::move(theDevice)), info(device->info()), sink(theSink) {
  for (HapticDevice* hand : device->hands()) {
    const DeviceInfo about = hand->info();
    hands.push_back({hand, about.rendersForce, DeviceWatch(about)});
    anyRendersForce = anyRendersForce || about.rendersForce;
  }
  // A virtual hand may look at every mass at every tick.
  if (const std::uint32_t every = sink != nullptr ? sink->massesEvery() : 0; every > 0 && !info.virtualHand) engine->setMassesEvery(every);
  copyState(engine->state(), snapshots.back());
  snapshots.publish();
}

bool LoopCore::enterDevice(Where from) noexcept { return where.compare_exchange_strong(from, Where::InDevice, std::memory_order_acq_rel); }

bool LoopCore::leaveDevice() noexcept {
  Where inside = Where::InDevice;
  return where.compare_exchange_strong(inside, Where::Computing, std::memory_order_acq_rel);
}

bool LoopCore::abandon() noexcept {
  for (const Where from : {Where::Idle, Where::InDevice}) {
    Where expected = from;
    if (where.compare_exchange_strong(expected, Where::Abandoned, std::memory_order_acq_rel) || expected == Where::Abandoned) return true;
  }
  return false;
}

void LoopCore::latch(DeviceFault fault, int hand) noexcept {
  LatchedFault none;
  if (fault != DeviceFault::None)
    latched.compare_exchange_strong(none, {fault, static_cast<std::uint8_t>(hand)}, std::memory_order_acq_rel);
}

void LoopCore::countLateness(std::int64_t latenessNs, std::uint32_t missed) noexcept {
  lateness.add(latenessNs);
  if (missed == 0) return;
  raise(late, std::uint64_t{1});
  raise(missedTicks, std::uint64_t{missed});
  if (const auto gap = static_cast<std::uint64_t>(latenessNs + kPeriodNs); gap > longestGapNs.load(std::memory_order_relaxed))
    longestGapNs.store(gap, std::memory_order_relaxed);
}

// The watchdog may latch while this tick is being computed: what it has told the device must be the last word.
void LoopCore::writeForces() noexcept {
  const TickState& state = engine->state();
  const bool give = !hasFault();
  for (std::size_t i = 0; i < hands.size(); ++i) hands[i].device->write(give ? state.hands[i].deviceForce : Vec3{});
  if (hasFault()) writeZero();
}

void LoopCore::writeZero() noexcept {
  for (const Hand& hand : hands) hand.device->write({});
}

void LoopCore::acceptReset() noexcept {
  if (!resetAsked.load(std::memory_order_acquire)) return;
  resetAsked.store(false, std::memory_order_release);
  for (Hand& hand : hands) hand.watch.reset();
  latched.store({}, std::memory_order_release);
}

void LoopCore::writeLastZero() noexcept {
  if (!enterDevice(Where::Idle)) return;
  writeZero();
  if (leaveDevice()) where.store(Where::Idle, std::memory_order_release);
}

struct LoopCore::Stages {
  LoopCore& core;

  bool read(TickInput& input) noexcept {
    if (!core.enterDevice(Where::Idle)) return false;
    for (std::size_t i = 0; i < core.hands.size(); ++i) ::new (&input.devices[i]) DeviceSample(core.hands[i].device->read());
    return core.leaveDevice();
  }

  void watch(TickInput& input) noexcept {
    if (!core.anyRendersForce) return;
    core.acceptReset();
    // Before a sample is looked at: a force that the engine has let grow while the device was not given it would come as a kick. A force
    // device that was lost is not taken back: plugged in again, it may count its places from elsewhere.
    for (std::size_t i = 0; i < core.hands.size(); ++i) {
      const DeviceHealth health = core.hands[i].device->health();
      if (health == DeviceHealth::Failed || (health == DeviceHealth::Lost && core.hands[i].rendersForce))
        core.latch(DeviceFault::Device, static_cast<int>(i));
    }
    const WatchContext context{trial::isEngaged(core.engine->state().phase), input.missedTicks, input.measuredNs};
    for (std::size_t i = 0; i < core.hands.size(); ++i) {
      Hand& hand = core.hands[i];
      if (!hand.rendersForce) continue;
      hand.watch.latch(core.latched.load(std::memory_order_acquire).fault);
      input.devices[i] = hand.watch.look(input.devices[i], context);
      core.latch(hand.watch.fault(), static_cast<int>(i));
    }
    input.deviceFault = core.hasFault();
  }

  void command(TickInput& input) noexcept {
    Order order;
    (void)core.commands.tryPop(order);
    input.command = order.command;
    input.planned = order.planned;
  }

  bool write(const TickInput&) noexcept {
    const TickState& state = core.engine->state();
    for (std::size_t i = 0; i < core.hands.size() && core.anyRendersForce; ++i)
      if (!isFinite(state.hands[i].couplingForce)) core.latch(DeviceFault::NotFinite, static_cast<int>(i));
    if (!core.enterDevice(Where::Computing)) return false;
    core.writeForces();
    if (const auto cue = core.engine->cue()) core.device->cue(*cue);
    core.device->see({state.masses.data(), static_cast<std::size_t>(state.massCount)});
    if (!core.leaveDevice()) return false;
    core.forceOn.store(forceActs(state), std::memory_order_relaxed);
    return true;
  }

  void publish(const TickInput& input) noexcept {
    const TickState& state = core.engine->state();
    LoopFaults& faults = core.engine->faults();
    faults.lateTicks = core.late.load(std::memory_order_relaxed);
    faults.longestGapNs = core.longestGapNs.load(std::memory_order_relaxed);
    if (core.sink != nullptr && !core.sink->onTick(state, input.command, input.missedTicks)) {
      ++faults.droppedRecords;
      raise(core.dropped, std::uint64_t{1});
    }
    if (core.engine->sawAllMasses()) {  // what is shown is of one tick
      copyState(state, core.snapshots.back());
      core.snapshots.publish();
    }
    raise(core.ticks, std::uint64_t{1});
    core.lastNs.store(input.measuredNs, std::memory_order_relaxed);
    if (core.anyRendersForce) core.completedNs.store(os::now(), std::memory_order_release);
    core.where.store(Where::Idle, std::memory_order_release);
  }
};

bool LoopCore::tick(std::uint32_t missed, std::int64_t measuredNs) noexcept {
  input.missedTicks = missed;
  input.measuredNs = measuredNs;
  return runTick(*engine, input, Stages{*this});
}

void LoopCore::endWithoutDevice(std::int64_t nowNs) noexcept {
  const TickState& state = engine->state();
  const auto record = [&](trial::Command command, std::uint32_t missed) {
    if (sink != nullptr) sink->onTick(state, command, missed);
    raise(ticks, std::uint64_t{1});
  };
  if (state.tick > ticks.load(std::memory_order_relaxed)) record(input.command, input.missedTicks);  // computed, and not recorded yet
  TickInput lost;
  for (std::size_t i = 0; i < hands.size(); ++i) {
    lost.devices[i] = state.hands[i].device;
    lost.devices[i].valid = lost.devices[i].released = false;
  }
  lost.deviceFault = true;
  lost.measuredNs = nowNs;
  // Also a trial that was put up and that no tick has seen yet.
  for (int k = 0; k < 2 * trial::kLostTicks; ++k) {
    Order order;
    if (!commands.tryPop(order) && (state.phase == trial::Phase::Idle || state.phase == trial::Phase::Done)) break;
    lost.command = order.command;
    lost.planned = order.planned;
    (void)runTick(*engine, lost);
    record(lost.command, 0);
  }
  copyState(state, snapshots.back());
  snapshots.publish();
}

void LoopCore::tickOfDevice() noexcept {
  if (stopping.load(std::memory_order_acquire)) return;
  const std::int64_t now = os::now();
  if (deadlineNs == 0) {
    deadlineNs = now;
    firstNs.store(now, std::memory_order_relaxed);
  }
  if (now < deadlineNs - kPeriodNs / 2) {  // called twice in a period: not yet time for a tick
    if (!enterDevice(Where::Idle)) return;
    writeForces();
    if (leaveDevice()) where.store(Where::Idle, std::memory_order_release);
    return;
  }
  const std::int64_t lateNs = now > deadlineNs ? now - deadlineNs : 0;
  const auto missed = static_cast<std::uint32_t>(lateNs / kPeriodNs);
  countLateness(lateNs, missed);
  tick(missed, now);
  deadlineNs += (static_cast<std::int64_t>(missed) + 1) * kPeriodNs;
}

LoopReport reportOf(const LoopCore& core) {
  LoopReport report;
  report.ticks = core.ticks.load(std::memory_order_relaxed);
  report.seconds = static_cast<double>(core.lastNs.load(std::memory_order_relaxed) - core.firstNs.load(std::memory_order_relaxed)) * 1e-9;
  report.rate = report.seconds > 0 && report.ticks > 1 ? static_cast<double>(report.ticks - 1) / report.seconds : 0;
  report.latenessP50 = core.lateness.percentile(0.50) * 1e-3;
  report.latenessP99 = core.lateness.percentile(0.99) * 1e-3;
  report.latenessMax = core.lateness.max() * 1e-3;
  report.faults.lateTicks = core.late.load(std::memory_order_relaxed);
  report.faults.missedTicks = core.missedTicks.load(std::memory_order_relaxed);
  report.faults.longestGapNs = core.longestGapNs.load(std::memory_order_relaxed);
  report.faults.droppedRecords = core.dropped.load(std::memory_order_relaxed);
  report.mode = core.mode;
  report.realTime = core.realTime;
  return report;
}

}  // namespace reachlab::haptics
