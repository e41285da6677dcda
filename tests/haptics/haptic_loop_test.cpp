#include "sim/haptics/haptic_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <map>
#include <string>
#include <thread>
#include <utility>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/run_conductor.h"
#include "sim/haptics/tick_order.h"
#include "tests/haptics/armed_at_once.h"
#include "tests/haptics/scripted_device.h"
#include "tests/haptics/set_device.h"

namespace reachlab::haptics {
namespace {

using test::MemorySink;
using test::ScriptedDevice;
using test::SetDevice;

std::unique_ptr<ScriptedDevice> makeReach() { return std::make_unique<ScriptedDevice>(-0.1, 0.1, 300); }

// A loop of a shipped experiment on a scripted hand.
struct Looped {
  explicit Looped(const std::string& name, const LoopOptions& options = {.virtualClock = true, .clock = {}}, std::size_t ticks = 1000)
      : sink(ticks), loop(std::make_unique<TickEngine>(test::armedAtOnce(name), EngineOptions{}), device, &sink, options) {}
  std::shared_ptr<ScriptedDevice> device = makeReach();
  MemorySink sink;
  HapticLoop loop;
};

// A short task, so that a trial ends within half a second of real time.
experiment::Experiment shortTask() {
  experiment::Experiment experiment = test::armedPatiently("dingwell");
  experiment.task->duration = 0.4;
  experiment.task->tolerance.time = 0.1;
  return experiment;
}

TEST(HapticLoop, RealTimeGivesTheBitsOfTheVirtualClock) {
  const experiment::Experiment experiment = shortTask();
  const auto run = [&](bool virtualClock, MemorySink& sink) {
    RunConductor conductor(experiment::CompiledExperiment(experiment), makeReach(), {trial::PlannedTrial{}},
                           {.virtualClock = virtualClock, .clock = {}});
    conductor.start(&sink);
    const std::atomic<bool> stop{false};
    const auto trial = conductor.runTrial(stop);
    conductor.finish();
    return trial->result;
  };
  auto fast = std::make_unique<MemorySink>(2000), real = std::make_unique<MemorySink>(2000);
  const trial::TrialResult fastResult = run(true, *fast), realResult = run(false, *real);
  EXPECT_EQ(fastResult.outcome, realResult.outcome);
  EXPECT_EQ(fastResult.reason, realResult.reason);
  EXPECT_EQ(fastResult.by, realResult.by);
  EXPECT_EQ(fastResult.movementTime, realResult.movementTime);

  // Real time has idle ticks before the trial is put up; from there on tick by tick.
  const auto begin = [](const MemorySink& sink) {
    std::size_t i = 0;
    while (sink.ticks[i].command != trial::Command::NextTrial) ++i;
    return i;
  };
  const std::size_t f0 = begin(*fast), r0 = begin(*real), count = std::min(fast->ticks.size() - f0, real->ticks.size() - r0);
  ASSERT_GT(count, 400u);
  for (std::size_t i = 0; i < count; ++i) {
    const TickState &f = fast->ticks[f0 + i].state, &r = real->ticks[r0 + i].state;
    ASSERT_EQ(std::memcmp(&f.masses[0], &r.masses[0], sizeof(dynamics::MassState)), 0) << "tick " << i;
    ASSERT_EQ(f.hands[0].couplingForce, r.hands[0].couplingForce);
    ASSERT_EQ(f.phase, r.phase);
  }
}

TEST(HapticLoop, LeavesTheDeviceWithoutForce) {
  std::shared_ptr<ScriptedDevice> device;
  {
    Looped run("chain-moderate", {});
    device = run.device;
    run.loop.start();
    run.loop.tryCommand(trial::Command::NextTrial);
    while (run.loop.report().ticks < 200) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_FALSE(device->written.empty());
  EXPECT_EQ(device->written.back(), Vec3{});
}

TEST(RunConductor, InterruptsTheTrialUnderWayWhenAskedToStop) {
  for (const bool virtualClock : {true, false}) {
    RunConductor conductor(experiment::CompiledExperiment(test::armedAtOnce("chain-slow")), makeReach(), {trial::PlannedTrial{}},
                           {.virtualClock = virtualClock, .clock = {}});
    conductor.start(nullptr);
    const std::atomic<bool> stop{true};
    const auto trial = conductor.runTrial(stop);
    ASSERT_TRUE(trial);
    EXPECT_EQ(trial->result.outcome, trial::Outcome::Interrupted);
    EXPECT_EQ(trial->result.reason, trial::Reason::Experimenter);
  }
}

// A clock whose time passes as the test says: a microsecond a look, and at the sleeps that are named so much more.
class MadeClock final : public LoopClock {
 public:
  explicit MadeClock(std::map<int, std::int64_t> stalls) : stalls_(std::move(stalls)) { asked.reserve(100'000); }
  std::int64_t now() noexcept override { return time_ += 1000; }
  void sleepUntil(std::int64_t deadline) noexcept override {
    if (asked.size() < asked.capacity()) asked.push_back(deadline);
    time_ = std::max(time_, deadline);
    if (const auto stall = stalls_.find(static_cast<int>(asked.size())); stall != stalls_.end()) time_ += stall->second;
    std::this_thread::sleep_for(std::chrono::microseconds(20));
  }
  std::vector<std::int64_t> asked;

 private:
  std::map<int, std::int64_t> stalls_;
  std::int64_t time_ = 5'000'000'000;
};

// Deadlines stay on the grid of 1 ms whatever is missed, each tick comes at its own, and what was missed is counted once.
TEST(HapticLoop, KeepsToItsDeadlinesWhateverItMisses) {
  LoopOptions options;
  options.spinNs = 30'000;
  const auto clock =
      std::make_shared<MadeClock>(std::map<int, std::int64_t>{{10, 430'000}, {20, 3'430'000}, {30, 7'530'000}, {40, 1'080'000}});
  options.clock = clock;
  Looped run("chain-moderate", options);
  auto& [device, sink, loop] = run;
  loop.start();
  loop.start();  // once is enough
  while (loop.report().ticks < 60) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  loop.stop();
  ASSERT_GE(sink.ticks.size(), 60u);
  const std::map<int, std::uint32_t> missed{{20, 3}, {30, 7}, {40, 1}};
  const std::int64_t first = clock->asked[0] + options.spinNs;
  EXPECT_EQ(first, 5'000'000'000 + 1000 + 1'000'000) << "a period from the start";
  std::int64_t deadline = first;
  for (int i = 1; i <= 60; ++i) {
    const auto& seen = sink.ticks[static_cast<std::size_t>(i - 1)];
    EXPECT_EQ(clock->asked[static_cast<std::size_t>(i - 1)], deadline - options.spinNs) << i;
    const auto gap = missed.find(i);
    const std::uint32_t periods = gap == missed.end() ? 0 : gap->second;
    EXPECT_EQ(seen.missed, periods) << i;
    EXPECT_GE(seen.state.measuredNs, deadline + 1'000'000 * periods) << i;
    EXPECT_LT(seen.state.measuredNs, deadline + 1'000'000 * (periods + 1)) << i;
    if (i < 10) {
      EXPECT_LE(seen.state.measuredNs, deadline + 1000) << i << ": the rest of a wait is spun";
    }
    deadline += 1'000'000 * (periods + 1);
  }
  const LoopReport report = loop.report();
  EXPECT_EQ(report.faults.missedTicks, 11u);
  EXPECT_EQ(report.faults.lateTicks, 3u);
  EXPECT_NEAR(static_cast<double>(report.faults.longestGapNs), 8'501'000, 1000) << "7.5 ms late after the 1 ms that is due";
  EXPECT_NEAR(report.latenessMax, 7501, 1);
  EXPECT_NEAR(report.seconds, 1e-3 * static_cast<double>(report.ticks - 1 + 11), 1e-5);
  EXPECT_EQ(device->written.back(), Vec3{});
}

TEST(HapticLoop, SaysWhatPriorityAndMemoryItGot) {
  Looped run("dingwell", {.priority = 7, .clock = std::make_shared<MadeClock>(std::map<int, std::int64_t>{})});
  HapticLoop& loop = run.loop;
  loop.start();
  loop.stop();
  loop.stop();
  const LoopReport report = loop.report();
  const std::size_t comma = report.mode.find(", ");
  ASSERT_NE(comma, std::string::npos) << report.mode;
  EXPECT_EQ(report.realTime, report.mode.substr(0, comma) == "SCHED_FIFO 7") << report.mode;
  EXPECT_GT(report.mode.size(), comma + 2);
  EXPECT_FALSE(loop.hangs());
}

TEST(HapticLoop, TheVirtualClockStartsAtNoughtAndGoesByTicks) {
  Looped run("dingwell");
  auto& [device, sink, loop] = run;
  loop.start();  // nothing runs by itself
  EXPECT_EQ(loop.report().ticks, 0u);
  for (int i = 0; i < 3; ++i) loop.advance();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(sink.ticks[i].state.measuredNs, static_cast<std::int64_t>(i) * 1'000'000);
    EXPECT_EQ(sink.ticks[i].state.tick, i + 1);
    EXPECT_EQ(sink.ticks[i].missed, 0u);
  }
  device->written.clear();
  loop.stop();
  EXPECT_EQ(device->written, std::vector<Vec3>{Vec3{}});
  loop.stop();
  EXPECT_EQ(device->written.size(), 1u) << "once";
}

TEST(HapticLoop, TakesSixteenCommandsAtMostBeforeATick) {
  Looped run("dingwell");
  auto& [device, sink, loop] = run;
  for (int i = 0; i < 16; ++i) EXPECT_TRUE(loop.tryCommand(i % 2 == 0 ? trial::Command::NextTrial : trial::Command::Abort));
  EXPECT_FALSE(loop.tryCommand(trial::Command::Abort));
  for (int i = 0; i < 17; ++i) loop.advance();
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_EQ(sink.ticks[i].command, i % 2 == 0 ? trial::Command::NextTrial : trial::Command::Abort) << "in order, one a tick";
  EXPECT_EQ(sink.ticks[16].command, trial::Command::None);
}

// On the virtual clock with hands that the test sets.
class Conducted : public ::testing::Test {
 protected:
  Conducted() { options.virtualClock = true; }
  RunConductor& make(std::vector<trial::PlannedTrial> trials, const experiment::Experiment& experiment = shortTask()) {
    auto own = std::make_unique<SetDevice>(Vec3{-0.1, 0, 0}, "left");
    device = own.get();
    own->about.virtualHand = true;
    if (!experiment.hands.empty()) own->others = {&second};
    conductor = std::make_unique<RunConductor>(experiment::CompiledExperiment(experiment), std::move(own), std::move(trials), options);
    return *conductor;
  }
  LoopOptions options;
  SetDevice second{Vec3{-0.1, 0, 0}, "right"};
  SetDevice* device = nullptr;
  MemorySink sink{700};  // ticks of trials that are broken off, or of one that is not
  std::unique_ptr<RunConductor> conductor;
};

TEST_F(Conducted, EachTrialIsPreparedAnnouncedAndPutUpInItsOrder) {
  RunConductor& run = make({{4, 0, false}, {9, 30, false}});
  EXPECT_EQ(run.engine().state().tick, 0u) << "before the start, the engine that will run";
  EXPECT_EQ(run.latest().tick, 0u);
  EXPECT_EQ(run.latest().massCount, 1);
  EXPECT_EQ(run.device().name, "left");
  EXPECT_EQ(run.hands().size(), 1u);
  EXPECT_EQ(run.report().ticks, 0u);
  EXPECT_EQ(run.fault(), std::nullopt);
  run.finish();
  run.start(&sink);
  EXPECT_FALSE(sink.closed) << "a run that has not begun does not end";
  EXPECT_EQ(run.poll(), std::nullopt);
  EXPECT_EQ(run.trialsLeft(), 2u);
  EXPECT_EQ(run.nextPlanned()->index, 4);
  EXPECT_FALSE(run.underWay());
  ASSERT_TRUE(run.putUpNext());
  EXPECT_TRUE(run.underWay());
  EXPECT_FALSE(run.putUpNext()) << "one at a time";
  EXPECT_EQ(run.trialsLeft(), 1u);
  EXPECT_EQ(run.nextPlanned()->index, 9);
  run.abort();
  const auto aborted = run.poll();
  ASSERT_TRUE(aborted);
  EXPECT_EQ(aborted->trial, 1);
  EXPECT_EQ(aborted->planned.index, 4);
  EXPECT_EQ(aborted->result.outcome, trial::Outcome::Aborted);
  EXPECT_EQ(aborted->result.reason, trial::Reason::Experimenter);
  EXPECT_FALSE(run.underWay());
  EXPECT_EQ(run.poll(), std::nullopt) << "told once";
  ASSERT_TRUE(run.putUpNext());
  run.interrupt();
  const auto interrupted = run.poll();
  ASSERT_TRUE(interrupted);
  EXPECT_EQ(interrupted->trial, 2);
  EXPECT_EQ(interrupted->planned.index, 9);
  EXPECT_EQ(interrupted->planned.foreperiodTicks, 30);
  EXPECT_EQ(interrupted->result.outcome, trial::Outcome::Interrupted);
  EXPECT_FALSE(run.putUpNext());
  EXPECT_EQ(run.nextPlanned(), nullptr);
  EXPECT_EQ(run.runTrial(std::atomic<bool>{false}), std::nullopt);
  EXPECT_EQ(device->prepared, (std::vector<int>{4, 9}));
  EXPECT_EQ(sink.announced, (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(sink.awaited, (std::vector<std::int32_t>{1, 2}));
  run.finish();
  EXPECT_TRUE(sink.closed);
  sink.closed = false;
  run.finish();
  EXPECT_FALSE(sink.closed) << "once";
  EXPECT_EQ(run.report().ticks, sink.ticks.size());
}

// Whoever conducts, one tick is computed after the trial has ended.
TEST_F(Conducted, ARunEndsWithOneTickInDone) {
  for (const bool polled : {true, false}) {
    MemorySink ticks(700);
    RunConductor& run = make({{}});
    run.start(&ticks);
    if (polled) {
      ASSERT_TRUE(run.putUpNext());
      run.interrupt();
      ASSERT_TRUE(run.poll());
    } else {
      ASSERT_TRUE(run.runTrial(std::atomic<bool>{true}));
    }
    const std::size_t count = ticks.ticks.size();
    EXPECT_EQ(ticks.ticks[count - 1].state.phase, trial::Phase::Done);
    EXPECT_EQ(ticks.ticks[count - 2].state.phase, trial::Phase::Done);
    EXPECT_NE(ticks.ticks[count - 3].state.phase, trial::Phase::Done);
    EXPECT_EQ(run.latest().tick, count);
  }
}

TEST_F(Conducted, TrialsThatWereAppendedCanBeTakenBackWhileTheyAreToCome) {
  RunConductor& run = make({{0, 0, false}, {1, 0, false}});
  EXPECT_FALSE(run.takeBackAppended()) << "planned trials stay";
  run.append({5, 0, false});
  run.append({6, 0, false});
  EXPECT_EQ(run.trialsLeft(), 4u);
  EXPECT_TRUE(run.takeBackAppended());
  EXPECT_EQ(run.trialsLeft(), 3u);
  run.start(nullptr);
  for (const int index : {0, 1, 5}) {
    ASSERT_TRUE(run.putUpNext());
    run.abort();
    EXPECT_EQ(run.poll()->planned.index, index);
  }
  EXPECT_FALSE(run.takeBackAppended()) << "it has been done";
  run.append({7, 0, false});
  EXPECT_TRUE(run.takeBackAppended());
  EXPECT_FALSE(run.takeBackAppended());
  EXPECT_EQ(run.trialsLeft(), 0u);
}

TEST_F(Conducted, ASentenceSaysWhichDeviceIsLostAndWhy) {
  RunConductor& run = make({{}}, test::armedAtOnce("chain-two-hands"));
  ASSERT_EQ(run.hands().size(), 2u);
  EXPECT_EQ(run.hands()[1].name, "right");
  run.start(nullptr);
  EXPECT_EQ(run.fault(), std::nullopt);
  second.is = DeviceHealth::Lost;
  EXPECT_EQ(run.fault(), "device right is lost");
  second.says = "its plug is out";
  EXPECT_EQ(run.fault(), "device right is lost: its plug is out");
  second.is = DeviceHealth::Ready;
  device->is = DeviceHealth::Lost;
  device->says = "gone";
  EXPECT_EQ(run.fault(), "device left is lost: gone");
  device->is = DeviceHealth::Warm;
  EXPECT_EQ(run.fault(), std::nullopt);
}

TEST_F(Conducted, ASentenceSaysAtWhichHandAFaultWasFound) {
  const experiment::Experiment experiment = test::armedAtOnce("chain-two-hands");
  for (const int hand : {0, 1}) {
    auto own = std::make_unique<SetDevice>(Vec3{-0.1, 0, 0}, "left");
    own->others = {&second};
    own->about.rendersForce = second.about.rendersForce = true;
    SetDevice& broken = hand == 0 ? *own : second;
    own->is = second.is = DeviceHealth::Ready;
    RunConductor run(experiment::CompiledExperiment(experiment), std::move(own), {{}}, options);
    run.start(nullptr);
    broken.is = DeviceHealth::Failed;
    ASSERT_TRUE(run.putUpNext());
    ASSERT_TRUE(run.poll());  // a device that failed is a lost hand
    broken.is = DeviceHealth::Ready;
    broken.says = "a fuse";
    const auto sentence = run.fault();
    ASSERT_TRUE(sentence);
    const std::string begin = hand == 0 ? "device left reports a fault" : "device right reports a fault";
    EXPECT_EQ(sentence->substr(0, begin.size()), begin);
    EXPECT_EQ(sentence->substr(sentence->size() - 8), ": a fuse");
    broken.says.clear();
  }
}

// How often a trial was asked to stop.
class Interrupts final : public RunSink {
 public:
  bool onTick(const TickState&, trial::Command command, std::uint32_t) noexcept override {
    count += command == trial::Command::Interrupt ? 1 : 0;
    return true;
  }
  int count = 0;
};

// In real time whoever waits may look on, and is asked to stop but once.
TEST_F(Conducted, AWaitingCallerLooksOnAndStopsTheTrialOnce) {
  options = {};
  options.clock = std::make_shared<MadeClock>(std::map<int, std::int64_t>{});
  RunConductor& run = make({{}});
  Interrupts interrupts;
  run.start(&interrupts);
  std::atomic<bool> stop{false};
  int looks = 0;
  const auto trial = run.runTrial(stop, [&] { stop = ++looks > 3; });
  ASSERT_TRUE(trial);
  EXPECT_GE(looks, 1);
  run.finish();
  EXPECT_LE(interrupts.count, 1);
  EXPECT_GE(interrupts.count, trial->result.outcome == trial::Outcome::Interrupted ? 1 : 0);
}

}  // namespace
}  // namespace reachlab::haptics
