#include "sim/haptics/haptic_loop.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <thread>

#include "sim/haptics/run_conductor.h"
#include "tests/haptics/scripted_device.h"
#include "tests/haptics/armed_at_once.h"

namespace reachlab::haptics {
namespace {

using test::MemorySink;
using test::ScriptedDevice;

std::unique_ptr<ScriptedDevice> makeReach() { return std::make_unique<ScriptedDevice>(-0.1, 0.1, 300); }

// A short task, so that a trial ends within half a second of real time.
experiment::Experiment shortTask() {
  experiment::Experiment experiment = test::armedAtOnce("dingwell");
  experiment.task->duration = 0.4;
  experiment.task->tolerance.time = 0.1;
  experiment.timing = experiment::kNoTimingLimits;  // a busy machine spoils nothing here
  return experiment;
}

TEST(HapticLoop, RealTimeGivesTheBitsOfTheVirtualClock) {
  const experiment::Experiment experiment = shortTask();
  const auto run = [&](bool virtualClock, MemorySink& sink) {
    LoopOptions options;
    options.virtualClock = virtualClock;
    RunConductor conductor(experiment, makeReach(), {trial::PlannedTrial{}}, options);
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
    ASSERT_EQ(f.couplingForce, r.couplingForce);
    ASSERT_EQ(f.phase, r.phase);
  }
}

TEST(HapticLoop, TheLoggedInputsReproduceARealTimeRun) {
  const experiment::Experiment experiment = shortTask();
  auto sink = std::make_unique<MemorySink>(3000);
  RunConductor conductor(experiment, makeReach(), {trial::PlannedTrial{}});
  conductor.start(sink.get());
  conductor.runTrial(std::atomic<bool>{false});
  conductor.finish();
  TickEngine again(experiment, {12, true});
  for (const test::SeenTick& seen : sink->ticks) {
    again.tick({seen.state.device, seen.command, {}, seen.missed, seen.state.measuredNs});
    ASSERT_EQ(std::memcmp(&again.state().masses[0], &seen.state.masses[0], sizeof(dynamics::MassState)), 0);
    ASSERT_EQ(again.state().deviceForce, seen.state.deviceForce);
    ASSERT_EQ(again.state().phase, seen.state.phase);
  }
}

TEST(HapticLoop, LeavesTheDeviceWithoutForce) {
  const experiment::Experiment experiment = test::armedAtOnce("chain-moderate");
  ScriptedDevice device(-0.1, 0.1, 300);
  {
    HapticLoop loop(std::make_unique<TickEngine>(experiment, EngineOptions{}), device, nullptr);
    loop.start();
    loop.tryCommand(trial::Command::NextTrial);
    while (loop.report().ticks < 200) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_FALSE(device.written.empty());
  EXPECT_EQ(device.written.back(), Vec3{});
}

TEST(HapticLoop, ReportsWhatItAchieved) {
  ScriptedDevice device(-0.1, 0.1, 300);
  HapticLoop loop(std::make_unique<TickEngine>(test::armedAtOnce("chain-moderate"), EngineOptions{}), device, nullptr);
  loop.start();
  while (loop.report().ticks < 100) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  loop.stop();
  const LoopReport report = loop.report();
  EXPECT_GT(report.rate, 0);
  EXPECT_LE(report.latenessP50, report.latenessP99);
  EXPECT_LE(report.latenessP99, report.latenessMax);
  EXPECT_FALSE(report.mode.empty());
  // Every period since the first tick was either done or counted as missed.
  const double periods = report.seconds * 1000;
  EXPECT_NEAR(static_cast<double>(report.ticks + report.faults.missedTicks), periods + 1, 1.5) << "ends of the run are not on deadlines";
}

TEST(HapticLoop, CountsTicksThatTheRecorderCouldNotTake) {
  ScriptedDevice device(-0.1, 0.1, 300);
  MemorySink sink(10);
  LoopOptions options;
  options.virtualClock = true;
  HapticLoop loop(std::make_unique<TickEngine>(test::armedAtOnce("dingwell"), EngineOptions{}), device, &sink, options);
  for (int i = 0; i < 25; ++i) loop.advance();
  EXPECT_EQ(loop.engine().state().faults.droppedRecords, 15u);
  EXPECT_EQ(loop.report().faults.droppedRecords, 15u);
}

TEST(RunConductor, ConductsEveryTrialOnceAndWaitsForItsRecord) {
  MemorySink sink(1);
  LoopOptions options;
  options.virtualClock = true;
  RunConductor conductor(shortTask(), makeReach(), {trial::PlannedTrial{4}, trial::PlannedTrial{7}}, options);
  conductor.start(&sink);
  const std::atomic<bool> stop{false};
  std::vector<int> indices;
  while (const auto trial = conductor.runTrial(stop)) indices.push_back(trial->planned.index);
  conductor.finish();
  EXPECT_EQ(indices, (std::vector<int>{4, 7}));
  EXPECT_EQ(sink.announced, (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(sink.awaited, sink.announced);
  EXPECT_TRUE(sink.closed);
}

TEST(RunConductor, InterruptsTheTrialUnderWayWhenAskedToStop) {
  for (const bool virtualClock : {true, false}) {
    LoopOptions options;
    options.virtualClock = virtualClock;
    RunConductor conductor(test::armedAtOnce("chain-slow"), makeReach(), {trial::PlannedTrial{}}, options);
    conductor.start(nullptr);
    const std::atomic<bool> stop{true};
    const auto trial = conductor.runTrial(stop);
    ASSERT_TRUE(trial);
    EXPECT_EQ(trial->result.outcome, trial::Outcome::Interrupted);
    EXPECT_EQ(trial->result.reason, trial::Reason::Experimenter);
  }
}

TEST(RunConductor, CanBePolledLikeTheWindowDoes) {
  RunConductor conductor(shortTask(), makeReach(), {trial::PlannedTrial{}});
  conductor.start(nullptr);
  ASSERT_TRUE(conductor.putUpNext());
  EXPECT_FALSE(conductor.putUpNext()) << "one trial at a time";
  std::optional<ConductedTrial> ended;
  while (!ended) {
    ended = conductor.poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(conductor.latest().phase, trial::Phase::Done);
  EXPECT_EQ(conductor.trialsLeft(), 0u);
}

}  // namespace
}  // namespace reachlab::haptics
