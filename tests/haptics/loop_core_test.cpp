#include "sim/haptics/loop_core.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

#include "base/system/os.h"
#include "tests/haptics/armed_at_once.h"
#include "tests/haptics/scripted_device.h"
#include "tests/haptics/set_device.h"

// One tick of the loop on devices that are what the test says: what it reads, tells, latches and counts.
namespace reachlab::haptics {
namespace {

using test::MemorySink;
using test::SetDevice;

constexpr std::int64_t kPeriod = LoopCore::kPeriodNs;

// The chain that two hands hold by its ends; the second device is told by itself.
class TwoHandsCore : public ::testing::Test {
 protected:
  TwoHandsCore() {
    first->about.rendersForce = second.about.rendersForce = true;
    first->others = {&second};
    make();
  }
  void make(RunSink* sink = nullptr) {
    auto engine = std::make_unique<TickEngine>(test::armedPatiently("chain-two-hands"), engineOptions(*first));
    start = engine->protocol().start;
    first->sample.position = second.sample.position = start;
    core = std::make_unique<LoopCore>(std::move(engine), first, sink);
  }
  bool tick(trial::Command command = trial::Command::None, std::uint32_t missed = 0) {
    if (command != trial::Command::None) {
      EXPECT_TRUE(core->commands.tryPush({command, {}}));
    }
    ++first->sample.reports;
    ++second.sample.reports;
    return core->tick(missed, now += kPeriod);
  }
  // Until both hands feel something: the second goes the other way, and twice as fast.
  void engage() {
    tick(trial::Command::NextTrial);
    for (int i = 0; i < 250; ++i) tick();
    for (int i = 0; i < 60; ++i) {
      first->sample.position.x += 1e-4;
      second.sample.position.x -= 2e-4;
      tick();
    }
    ASSERT_GT(norm(first->written.back()), 0.5);
    ASSERT_GT(norm(second.written.back()), 0.5);
  }

  std::shared_ptr<SetDevice> first = std::make_shared<SetDevice>(Vec3{}, "left");
  SetDevice second{Vec3{}, "right"};
  std::unique_ptr<LoopCore> core;
  Vec3 start;
  std::int64_t now = 0;
};

TEST_F(TwoHandsCore, EachDeviceIsToldItsOwnForce) {
  engage();
  const TickState& state = core->engine->state();
  EXPECT_EQ(first->written.back(), state.hands[0].deviceForce);
  EXPECT_EQ(second.written.back(), state.hands[1].deviceForce);
  EXPECT_LT(first->written.back().x * second.written.back().x, 0) << "pulled apart";
  EXPECT_TRUE(core->forceOn);
  EXPECT_EQ(first->seen, 5u) << "all masses are shown";
  EXPECT_EQ(first->cues, (std::vector<Cue>{Cue::Place, Cue::Go}));
}

TEST_F(TwoHandsCore, AFaultIsOfTheHandItWasFoundAtAndTakesTheForceFromBoth) {
  for (const int hand : {0, 1})
    for (const bool jumps : {true, false}) {
      SCOPED_TRACE(testing::Message() << "hand " << hand << (jumps ? " jumps" : " says that it failed"));
      first->is = second.is = DeviceHealth::Ready;
      make();
      engage();
      SetDevice& device = hand == 0 ? *first : second;
      device.is = DeviceHealth::Warm;
      tick();
      EXPECT_EQ(core->latched.load().fault, DeviceFault::None) << "a warning is no failure";
      if (jumps) device.sample.position.y += 0.1;
      else device.is = DeviceHealth::Failed;
      tick();
      EXPECT_EQ(core->latched.load().fault, jumps ? DeviceFault::Jump : DeviceFault::Device);
      EXPECT_EQ(core->latched.load().hand, hand);
      EXPECT_EQ(first->written.back(), Vec3{});
      EXPECT_EQ(second.written.back(), Vec3{});
      EXPECT_EQ(core->engine->state().hands[0].deviceState, DeviceState::Fault);
      EXPECT_EQ(core->engine->state().hands[1].deviceState, DeviceState::Fault);
    }
}

TEST_F(TwoHandsCore, AResetLetsBothBeBelievedAgain) {
  engage();
  second.sample.position.y += 0.1;
  for (int i = 0; i < 30; ++i) tick();
  EXPECT_EQ(core->engine->state().phase, trial::Phase::Done);
  EXPECT_EQ(core->engine->state().result.reason, trial::Reason::DeviceLost);
  core->resetAsked = true;
  tick();
  EXPECT_FALSE(core->resetAsked);
  EXPECT_EQ(core->latched.load().fault, DeviceFault::None);
  first->sample.position = second.sample.position = start;
  tick(trial::Command::NextTrial);
  tick();
  EXPECT_EQ(core->engine->state().phase, trial::Phase::Armed);
  EXPECT_TRUE(core->engine->state().hands[1].device.valid);
}

TEST_F(TwoHandsCore, ADeviceThatOnlyShowsAPlaceIsNotLookedAtAndTheOtherIs) {
  for (const int shown : {0, 1}) {
    SCOPED_TRACE(shown);
    SetDevice &showing = shown == 0 ? *first : second, &rendering = shown == 0 ? second : *first;
    showing.about.rendersForce = false;
    rendering.about.rendersForce = true;
    make();
    EXPECT_TRUE(core->anyRendersForce);
    engage();
    showing.sample.position.y += 0.1;
    tick();
    EXPECT_EQ(core->latched.load().fault, DeviceFault::None);
    EXPECT_GT(core->completedNs, 0) << "the watchdog looks after the other";
    rendering.sample.position.y += 0.1;
    tick();
    EXPECT_EQ(core->latched.load().fault, DeviceFault::Jump);
    EXPECT_EQ(core->latched.load().hand, 1 - shown);
  }
}

TEST_F(TwoHandsCore, TheFirstFaultStaysWithItsHand) {
  core->latch(DeviceFault::None, 1);
  EXPECT_EQ(core->latched.load().fault, DeviceFault::None);
  EXPECT_EQ(core->latched.load().hand, 0);
  core->latch(DeviceFault::Silent, 1);
  core->latch(DeviceFault::Jump, 0);
  EXPECT_EQ(core->latched.load().fault, DeviceFault::Silent);
  EXPECT_EQ(core->latched.load().hand, 1);
}

// The tick and the watchdog may find a fault at one moment: fault and hand are of one of them.
TEST_F(TwoHandsCore, OfTwoFaultsAtOneMomentTheHandIsThatOfTheFirst) {
  for (int round = 0; round < 5000; ++round) {
    core->latched = LatchedFault{};
    std::atomic<bool> go{false};
    std::jthread other([&] {
      while (!go) {}
      core->latch(DeviceFault::Jump, 1);
    });
    go = true;
    core->latch(DeviceFault::Silent, 0);
    other.join();
    const LatchedFault latched = core->latched;
    ASSERT_EQ(latched.fault == DeviceFault::Jump, latched.hand == 1) << round;
  }
}

TEST_F(TwoHandsCore, TheLastWordToEveryDeviceIsZero) {
  engage();
  core->writeLastZero();
  EXPECT_EQ(first->written.back(), Vec3{});
  EXPECT_EQ(second.written.back(), Vec3{});
  EXPECT_TRUE(tick()) << "as long as nobody has left it";
  ASSERT_TRUE(core->abandon());
  const std::size_t told = first->written.size();
  core->writeLastZero();
  EXPECT_EQ(first->written.size(), told) << "what was left is not touched any more";
}

// Left behind while the device holds it, in a read or a write: nothing is touched when the call returns.
TEST_F(TwoHandsCore, ATickThatIsLeftBehindTouchesNothing) {
  for (const bool inWrite : {false, true}) {
    *first = SetDevice(Vec3{}, "left");
    first->others = {&second};
    make();
    tick(trial::Command::NextTrial);
    const std::uint64_t ticks = core->ticks, computed = core->engine->state().tick;
    (inWrite ? first->whileItIsTold : first->whileItIsRead) = [&] { EXPECT_TRUE(core->abandon()); };
    EXPECT_FALSE(tick());
    EXPECT_EQ(core->ticks, ticks);
    EXPECT_EQ(core->engine->state().tick, computed + (inWrite ? 1 : 0));
    EXPECT_TRUE(core->abandon()) << "it stays so";
    first->whileItIsRead = first->whileItIsTold = nullptr;
    const int reads = first->reads;
    EXPECT_FALSE(tick());
    EXPECT_EQ(first->reads, reads);
  }
}

// What a test wants to know within a tick, while it is computed.
class Asking final : public RunSink {
 public:
  bool onTick(const TickState&, trial::Command, std::uint32_t) noexcept override {
    abandoned = core->abandon();
    return true;
  }
  std::uint32_t massesEvery() const noexcept override { return every; }
  LoopCore* core = nullptr;
  bool abandoned = true;
  std::uint32_t every = 1;
};

TEST_F(TwoHandsCore, ATickThatComputesIsNotLeftBehind) {
  Asking sink;
  make(&sink);
  sink.core = core.get();
  EXPECT_TRUE(tick());
  EXPECT_FALSE(sink.abandoned);
  EXPECT_EQ(core->where, LoopCore::Where::Idle);
}

class Core : public ::testing::Test {
 protected:
  LoopCore& make(RunSink* sink = nullptr, const std::string& name = "chain-slow") {
    auto engine = std::make_unique<TickEngine>(test::armedPatiently(name), engineOptions(*device));
    device->sample.position = engine->protocol().start;
    core = std::make_unique<LoopCore>(std::move(engine), device, sink);
    return *core;
  }
  std::shared_ptr<SetDevice> device = std::make_shared<SetDevice>();
  std::unique_ptr<LoopCore> core;
};

TEST_F(Core, ShowsTheObjectAtItsStartBeforeTheFirstTick) {
  make();
  const TickState* state = core->snapshots.takeLatest();
  ASSERT_NE(state, nullptr);
  EXPECT_EQ(state->tick, 0u);
  EXPECT_EQ(state->massCount, 5);
  EXPECT_EQ(state->masses[4].r, core->engine->protocol().start);
  EXPECT_EQ(core->snapshots.takeLatest(), nullptr);
  EXPECT_EQ(core->mode, "virtual clock");
}

TEST_F(Core, CountsHowLateItsTicksAre) {
  make();
  core->countLateness(250'000, 0);
  EXPECT_EQ(core->late, 0u);
  EXPECT_EQ(core->longestGapNs, 0u) << "less than a period late is no gap";
  core->countLateness(3'400'000, 3);
  core->countLateness(7'100'000, 7);
  core->countLateness(2'000'000, 2);
  core->firstNs = 5'000'000'000;
  core->lastNs = 7'500'000'000;
  core->ticks = 2001;
  core->dropped = 4;
  core->mode = "as told";
  core->realTime = true;
  const LoopReport report = reportOf(*core);
  EXPECT_EQ(report.faults.lateTicks, 3u);
  EXPECT_EQ(report.faults.missedTicks, 12u);
  EXPECT_EQ(report.faults.longestGapNs, 8'100'000u) << "from one tick to the next";
  EXPECT_EQ(report.faults.droppedRecords, 4u);
  EXPECT_EQ(report.ticks, 2001u);
  EXPECT_DOUBLE_EQ(report.seconds, 2.5);
  EXPECT_DOUBLE_EQ(report.rate, 800) << "from the first tick to the last are one less";
  EXPECT_DOUBLE_EQ(report.latenessMax, 7100) << "microseconds";
  EXPECT_NEAR(report.latenessP50, 2000, 2000.0 / 16);
  EXPECT_NEAR(report.latenessP99, 7100, 7100.0 / 16);
  EXPECT_EQ(report.mode, "as told");
  EXPECT_TRUE(report.realTime);
  core->ticks = 1;
  EXPECT_EQ(reportOf(*core).rate, 0) << "of one tick there is none";
}

TEST_F(Core, ForceActsInATrialAndWhileAStylusIsHeld) {
  make();
  core->tick(0, 0);
  EXPECT_FALSE(core->forceOn);
  core->commands.tryPush({trial::Command::NextTrial, {}});
  core->tick(0, 0);
  EXPECT_FALSE(core->forceOn) << "put up, not armed";
  core->tick(0, 0);
  EXPECT_TRUE(core->forceOn);
  device->about.guards.compensation = {0, 1, 0};
  make();
  core->tick(0, 0);
  EXPECT_TRUE(core->forceOn);
  EXPECT_EQ(core->completedNs, 0) << "nobody watches a device that renders no force";
}

TEST_F(Core, KeepsTheTimeAndTheGapsThatItIsTold) {
  MemorySink sink(2);
  make(&sink);
  core->countLateness(3'400'000, 3);
  EXPECT_TRUE(core->tick(3, 77'000));
  EXPECT_TRUE(core->tick(0, 1'077'000));
  EXPECT_EQ(core->lastNs, 1'077'000);
  EXPECT_EQ(core->ticks, 2u);
  ASSERT_EQ(sink.ticks.size(), 2u);
  EXPECT_EQ(sink.ticks[0].missed, 3u);
  EXPECT_EQ(sink.ticks[0].state.measuredNs, 77'000);
  EXPECT_EQ(sink.ticks[1].state.measuredNs, 1'077'000);
  EXPECT_EQ(sink.ticks[1].state.faults.missedTicks, 3u);
  EXPECT_EQ(sink.ticks[1].state.faults.lateTicks, 1u);
  EXPECT_EQ(sink.ticks[1].state.faults.longestGapNs, 4'400'000u);
  core->tick(0, 0);
  EXPECT_EQ(core->dropped, 1u) << "no room for a third";
  EXPECT_EQ(core->engine->state().faults.droppedRecords, 1u);
}

// A chain of 40, of which the recorder wants every mass at each seventh tick.
TEST_F(Core, ShowsOnlyTicksInWhichEveryMassWasSeen) {
  for (const bool virtualHand : {false, true})
    for (const std::uint32_t every : {0u, 7u}) {
      Asking sink;
      sink.every = every;
      device->about.virtualHand = virtualHand;
      experiment::Experiment experiment = test::armedPatiently("chain-moderate");
      experiment.object.masses.assign(40, 3.0 / 40);
      experiment.object.stiffness.assign(39, 4800);
      experiment.object.damping.assign(39, 0);
      auto engine = std::make_unique<TickEngine>(experiment, engineOptions(*device));
      device->sample.position = engine->protocol().start;
      core = std::make_unique<LoopCore>(std::move(engine), device, &sink);
      sink.core = core.get();
      core->commands.tryPush({trial::Command::NextTrial, {}});
      core->tick(0, 0);
      core->tick(0, 0);
      ASSERT_EQ(core->engine->state().phase, trial::Phase::Armed);
      core->snapshots.takeLatest();
      for (int i = 0; i < 14; ++i) {
        core->tick(0, 0);
        const bool shown = core->snapshots.takeLatest() != nullptr;
        EXPECT_EQ(shown, virtualHand || every == 0 || core->engine->state().tick % 7 == 0) << core->engine->state().tick;
      }
    }
}

// A clock that the device drives: calls before half a period repeat the force, a late one counts the periods that it missed.
TEST_F(Core, CallsOfADeviceAreTicksAtTheirTime) {
  make();
  core->tickOfDevice();
  EXPECT_EQ(core->ticks, 1u);
  const std::int64_t first = core->firstNs;
  EXPECT_GT(first, 0);
  EXPECT_EQ(core->deadlineNs, first + kPeriod) << "the first call is on time";
  core->deadlineNs = os::now() + 1'000'000'000'000;  // far away, however long this computer stands still
  const std::size_t told = device->written.size();
  core->tickOfDevice();
  EXPECT_EQ(core->ticks, 1u);
  EXPECT_EQ(device->written.size(), told + 1) << "the last force is told once more";
  EXPECT_EQ(core->where, LoopCore::Where::Idle);
  const std::int64_t deadline = os::now() - 10 * kPeriod - kPeriod / 2;
  core->deadlineNs = deadline;
  core->tickOfDevice();
  EXPECT_EQ(core->ticks, 2u);
  const auto missed = static_cast<std::int64_t>(core->missedTicks.load());
  EXPECT_GE(missed, 10);
  EXPECT_EQ(core->late, 1u);
  EXPECT_EQ(core->deadlineNs, deadline + (missed + 1) * kPeriod);
  EXPECT_EQ(core->lastNs / kPeriod - deadline / kPeriod, missed + (core->lastNs % kPeriod < deadline % kPeriod ? 1 : 0));
  EXPECT_EQ(core->engine->state().faults.missedTicks, static_cast<std::uint64_t>(missed));
  EXPECT_EQ(core->longestGapNs, static_cast<std::uint64_t>(core->lastNs - deadline + kPeriod));
  EXPECT_EQ(core->firstNs, first);
  core->stopping = true;
  core->tickOfDevice();
  EXPECT_EQ(core->ticks, 2u);
  core->stopping = false;
  ASSERT_TRUE(core->abandon());
  core->deadlineNs = os::now() + 1'000'000'000'000;  // far away, however long this computer stands still
  const std::size_t before = device->written.size();
  core->tickOfDevice();
  EXPECT_EQ(device->written.size(), before) << "what was left is not told anything";
}

// Half a period early is still time for a tick: devices do not call to the nanosecond.
TEST_F(Core, ACallALittleEarlyIsATickWithoutLateness) {
  make();
  core->tickOfDevice();
  std::int64_t deadline = 0;
  do {  // again, should the computer take longer than 0.4 ms here
    deadline = core->deadlineNs = os::now() + kPeriod * 4 / 10;
    core->tickOfDevice();
  } while (core->lastNs >= deadline);
  EXPECT_EQ(core->deadlineNs, deadline + kPeriod);
  EXPECT_EQ(core->missedTicks, 0u);
}

}  // namespace
}  // namespace reachlab::haptics
