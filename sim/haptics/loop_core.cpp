#include "sim/haptics/loop_core.h"

#include "base/system/os.h"

namespace reachlab::haptics {
namespace {

// A counter with one writer.
template <typename T>
void raise(std::atomic<T>& counter, T by) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

bool forcesAreFinite(const TickState& state) noexcept {
  for (int hand = 0; hand < state.handCount; ++hand)
    if (!isFinite(handOf(state, hand).couplingForce)) return false;
  return true;
}

// A trial is under way, or a stylus is held against its weight.
bool forceActs(const TickState& state) noexcept {
  bool acts = trial::isEngaged(state.phase);
  for (int hand = 0; hand < state.handCount; ++hand) acts = acts || !(handOf(state, hand).deviceForce == Vec3{});
  return acts;
}

}  // namespace

LoopCore::LoopCore(std::unique_ptr<TickEngine> theEngine, std::shared_ptr<HapticDevice> theDevice, RunSink* theSink)
    : engine(std::move(theEngine)), device(std::move(theDevice)), info(device->info()), sink(theSink), deviceWatch(info),
      anyRendersForce(info.rendersForce) {
  for (HapticDevice* other : device->otherHands()) {
    const DeviceInfo about = other->info();
    others.push_back({other, about, DeviceWatch(about)});
    anyRendersForce = anyRendersForce || about.rendersForce;
  }
  otherSamples.resize(others.size());
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

void LoopCore::latch(DeviceFault newFault, int hand) noexcept {
  DeviceFault none = DeviceFault::None;
  if (newFault == DeviceFault::None || fault.load(std::memory_order_acquire) != none) return;
  faultHand.store(hand, std::memory_order_relaxed);
  fault.compare_exchange_strong(none, newFault, std::memory_order_acq_rel);
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
  const bool give = fault.load(std::memory_order_acquire) == DeviceFault::None;
  device->write(give ? state.deviceForce : Vec3{});
  for (std::size_t i = 0; i < others.size(); ++i) others[i].device->write(give ? state.others[i].deviceForce : Vec3{});
  if (fault.load(std::memory_order_acquire) != DeviceFault::None) writeZero();
}

void LoopCore::writeZero() noexcept {
  device->write({});
  for (const OtherDevice& other : others) other.device->write({});
}

void LoopCore::acceptReset() noexcept {
  if (!resetAsked.load(std::memory_order_acquire)) return;
  resetAsked.store(false, std::memory_order_release);
  deviceWatch.reset();
  for (OtherDevice& other : others) other.watch.reset();
  fault.store(DeviceFault::None, std::memory_order_release);
}

DeviceSample LoopCore::watched(int hand, HapticDevice& watchedDevice, DeviceWatch& watch, const DeviceSample& sample, std::uint32_t missed,
                               std::int64_t measuredNs) noexcept {
  watch.latch(fault.load(std::memory_order_acquire));
  // Before it is looked at: a force that the engine has let grow while the device was not given it would come as a kick.
  if (watchedDevice.health() == DeviceHealth::Failed) watch.latch(DeviceFault::Device);
  const TickState& before = engine->state();
  const DeviceSample believed = watch.look(sample, {trial::isEngaged(before.phase), missed, measuredNs});
  latch(watch.fault(), hand);
  return believed;
}

void LoopCore::writeLastZero() noexcept {
  if (!enterDevice(Where::Idle)) return;
  writeZero();
  if (leaveDevice()) where.store(Where::Idle, std::memory_order_release);
}

bool LoopCore::tick(std::uint32_t missed, std::int64_t measuredNs) noexcept {
  TickInput input;
  if (!enterDevice(Where::Idle)) return false;
  input.device = device->read();
  for (std::size_t i = 0; i < others.size(); ++i) otherSamples[i] = others[i].device->read();
  if (!leaveDevice()) return false;
  if (anyRendersForce) {
    acceptReset();
    if (info.rendersForce) input.device = watched(0, *device, deviceWatch, input.device, missed, measuredNs);
    for (std::size_t i = 0; i < others.size(); ++i)
      if (OtherDevice& other = others[i]; other.info.rendersForce)
        otherSamples[i] = watched(static_cast<int>(i) + 1, *other.device, other.watch, otherSamples[i], missed, measuredNs);
    input.deviceFault = fault.load(std::memory_order_acquire) != DeviceFault::None;
  }
  input.others = otherSamples;
  Order order;
  if (commands.tryPop(order)) {
    input.command = order.command;
    input.planned = order.planned;
  }
  input.missedTicks = missed;
  input.measuredNs = measuredNs;
  engine->tick(input);
  const TickState& state = engine->state();
  if (anyRendersForce && !forcesAreFinite(state)) latch(DeviceFault::NotFinite);

  if (!enterDevice(Where::Computing)) return false;
  writeForces();
  if (const auto cue = engine->cue()) device->cue(*cue);
  device->see({state.masses.data(), static_cast<std::size_t>(state.massCount)});
  if (!leaveDevice()) return false;
  forceOn.store(forceActs(state), std::memory_order_relaxed);

  LoopFaults& faults = engine->faults();
  faults.lateTicks = late.load(std::memory_order_relaxed);
  faults.longestGapNs = longestGapNs.load(std::memory_order_relaxed);
  if (sink != nullptr && !sink->onTick(state, input.command, missed)) {
    ++faults.droppedRecords;
    raise(dropped, std::uint64_t{1});
  }
  if (engine->sawAllMasses()) {  // what is shown is of one tick
    copyState(state, snapshots.back());
    snapshots.publish();
  }
  raise(ticks, std::uint64_t{1});
  lastNs.store(measuredNs, std::memory_order_relaxed);
  if (anyRendersForce) completedNs.store(os::now(), std::memory_order_release);
  where.store(Where::Idle, std::memory_order_release);
  return true;
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
