#include "sim/record/log/atomic_file.h"
#include "sim/session/recorded_run.h"

#include <chrono>
#include <filesystem>

#include "base/fault.h"
#include "tests/refusal.h"
#include "tests/haptics/set_device.h"
#include "tests/record/configuration_keys.h"
#include "tests/session/recorded_runs.h"

// One run from its log to the dataset.
namespace reachlab::session {
namespace {

using haptics::test::MemorySink;
using record::expectRecorded;
using test::goodHand;
using test::kNeverStop;
using test::Recorded;
using test::stillHand;

TEST_F(Recorded, EveryTrialIsInTheLogAndTheRunInTheDataset) {
  RecordedRun run(block(), goodHand(), options());
  EXPECT_EQ(run.trialCount(), 3u);
  EXPECT_FALSE(run.underWay());
  for (int trial = 1; trial <= 3; ++trial) {
    const auto ended = run.runTrial(kNeverStop);
    ASSERT_TRUE(ended);
    EXPECT_EQ(ended->result.outcome, trial::Outcome::Success) << nameOf(ended->result.reason);
    EXPECT_EQ(run.numberOf(*ended), trial);
    EXPECT_EQ(record::RunLog::open(run.logPath()).trials().size(), static_cast<std::size_t>(trial)) << "safe on the disk before it is told";
  }
  EXPECT_FALSE(run.runTrial(kNeverStop));
  EXPECT_FALSE(record::RunLog::open(run.logPath()).closed());
  run.closeLog();
  EXPECT_TRUE(record::RunLog::open(run.logPath()).closed());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "data/dataset_description.json"));
  run.finish();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "data/dataset_description.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "data/sub-01/ses-01/motion"));
  EXPECT_TRUE(run.timing().empty()) << "the virtual clock keeps no time";
  const record::RunConfiguration c = logs().at(0).configuration();
  expectRecorded(c, {{"device_name", "scripted"}, {"device_version", "7"}, {"device_max_force_n", 9.0}, {"virtual_hand", true}});
  expectRecorded(c, {{"clock", "virtual"}, {"experiment_name", "easy"}});
  EXPECT_EQ(c.table.massCount, 1);
}

TEST_F(Recorded, WhatTheDeviceSaysOfItselfIsInTheLog) {
  auto own = std::make_unique<haptics::test::SetDevice>();  // it renders force, so that its own facts are in the record
  own->about.maxContinuousForce = 3;
  own->about.thermalSeconds = 20;
  own->about.virtualHand = own->about.rendersForce = true;
  own->about.mapping = R"({"scale":2})";
  RecordedRun(block(), std::move(own), options()).finish();
  RecordedRun(block(), goodHand(), options()).finish();
  const record::RunConfiguration felt = logs().at(0).configuration(), shown = logs().at(1).configuration();
  EXPECT_FALSE(shown.firstHand.rendersForce);
  expectRecorded(felt, {{"device_renders_force", true}, {"device_continuous_force_n", 3.0}, {"device_thermal_s", 20.0}});
  EXPECT_EQ(felt.firstHand.mapping, R"({"scale":2})");
  EXPECT_TRUE(felt.computer.starts_with("Linux ")) << felt.computer;
  EXPECT_TRUE(felt.softwareVersion.starts_with("reachlab "));
  EXPECT_FALSE(felt.method.empty());
}

TEST_F(Recorded, ADestroyedRunIsFinishedAndItsTrialUnderWayIsInterrupted) {
  {
    RecordedRun run(block(), goodHand(), options());
    ASSERT_TRUE(run.putUpNext());
    EXPECT_TRUE(run.underWay());
    EXPECT_FALSE(run.putUpNext()) << "one is under way";
  }
  const std::vector<record::RunLog> found = logs();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].closed());
  ASSERT_EQ(found[0].trials().size(), 1u);
  EXPECT_EQ(found[0].trials()[0].result.outcome, trial::Outcome::Interrupted);
}

TEST_F(Recorded, ARunWithoutATrialLeavesAnOrderlyLog) {
  RecordedRun run(block(), goodHand(), options());
  EXPECT_FALSE(run.poll());
  run.abort();  // there is nothing to abort
  run.finish();
  EXPECT_TRUE(logs().at(0).closed());
  EXPECT_TRUE(logs().at(0).trials().empty());
}

TEST_F(Recorded, TheVirtualClockIsRefusedToAHandInRealTimeBeforeAnythingIsWritten) {
  auto real = test::handTo(0.1);
  real->about.virtualHand = false;
  const Fault fault = faultsToldBy([&] { RecordedRun run(block(), std::move(real), options()); }).at(0);
  EXPECT_EQ(fault.key, "fast");
  EXPECT_TRUE(holds(fault.what, "scripted"));
  EXPECT_TRUE(recordedRuns(request_.place).empty());
}

TEST_F(Recorded, EachRunTakesTheNumberThatIsFreeWhenItIsOpened) {
  const BlockToRun planned = block();
  RecordedRun first(planned, goodHand(), options()), second(planned, goodHand(), options());
  EXPECT_EQ(first.configuration().run, 1);
  EXPECT_EQ(second.configuration().run, 2);
  EXPECT_EQ(second.configuration().firstRun, 2);
  EXPECT_NE(first.logPath(), second.logPath());
  request_.run = 7;
  const BlockToRun asked = block();
  RecordedRun seventh(asked, goodHand(), options());
  EXPECT_EQ(seventh.configuration().run, 7);
  EXPECT_THROW(RecordedRun(asked, goodHand(), options()), FaultError) << "a number that was asked for is not exchanged";
}

TEST_F(Recorded, AnAbortedTrialIsPutUpOnceMoreIfTheBlockSaysSoAndARepeatIsNot) {
  for (const bool repeat : {false, true}) {
    BlockToRun wanted = block();
    wanted.configuration.repeatAborted = repeat;
    RecordedRun run(wanted, stillHand(), options());
    std::vector<int> indices;
    while (const auto ended = run.runTrial(kNeverStop)) {
      EXPECT_EQ(ended->result.outcome, trial::Outcome::Aborted);
      indices.push_back(ended->planned.index);
    }
    EXPECT_EQ(indices, (repeat ? std::vector<int>{0, 1, 2, 0, 1, 2} : std::vector<int>{0, 1, 2}));
    EXPECT_EQ(run.trialCount(), indices.size());
  }
  BlockToRun wanted = block();  // from a timer, as a window does
  wanted.configuration.repeatAborted = true;
  RecordedRun run(wanted, stillHand(), options());
  int ended = 0;
  while (run.putUpNext()) ended += run.poll().has_value();
  EXPECT_EQ(ended, 6);
}

TEST_F(Recorded, ATrialIsRepeatedByHandUnderItsOwnIndex) {
  RecordedRun run(block(), goodHand(), options());
  const auto first = run.runTrial(kNeverStop);
  run.repeat(first->planned);
  EXPECT_EQ(run.trialCount(), 4u);
  EXPECT_EQ(run.trialsLeft(), 3u);
  while (run.runTrial(kNeverStop)) {}
  run.finish();
  const record::RunLog log = logs().at(0);
  ASSERT_EQ(log.trials().size(), 4u);
  EXPECT_EQ(log.trials()[3].trial, 4);
  EXPECT_EQ(log.trials()[3].planned.index, 0);
}

TEST_F(Recorded, WhoWatchesSeesEveryTickAndCannotLoseOneForTheRecord) {
  MemorySink watcher(500);  // soon full
  RecordedRunOptions watched = options();
  watched.watchers = {&watcher};
  RecordedRun run(block(), goodHand(), watched);
  while (run.runTrial(kNeverStop)) {}
  run.finish();
  const record::RunLog log = logs().at(0);
  EXPECT_EQ(run.latest().faults.droppedRecords, 0u);
  const std::vector<record::RecordedTick> ticks = log.ticks();
  ASSERT_EQ(watcher.ticks.size(), 500u);
  ASSERT_GT(ticks.size(), 500u);
  EXPECT_EQ(watcher.ticks.back().state.tick - watcher.ticks.front().state.tick, 499u);
  EXPECT_EQ(watcher.announced, (std::vector<std::int32_t>{1, 2, 3}));
}

TEST_F(Recorded, AFinishedRunLeavesTheDatasetAlone) {
  const std::string file = request_.place.data + "/participants.tsv";
  {
    RecordedRun run(block(), goodHand(), options());
    (void)run.runTrial(kNeverStop);
    run.finish();
    ASSERT_TRUE(std::filesystem::remove(file));
    run.finish();
  }
  EXPECT_FALSE(std::filesystem::exists(file)) << "it was written when the run was finished, and not again";
}

TEST_F(Recorded, WhatAKilledProgramLeftIsRemovedWhenTheNextRunIsOpened) {
  const std::string left = request_.place.data + "/sub-01/.0123456789abcdef.reachlab-tmp";
  record::writeFileAtomically(left, "half a table");
  std::filesystem::last_write_time(left, std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
  const RecordedRun run(block(), goodHand(), options());
  EXPECT_FALSE(std::filesystem::exists(left));
}

TEST_F(Recorded, AFolderThatRefusesIsAFaultOfTheDataset) {
  request_.place.data = "/dev/null/data";
  EXPECT_THROW(RecordedRun(block(), goodHand(), options()), DatasetError);
}

TEST_F(Recorded, InRealTimeTheLogHasNotesAndHowWellTheLoopKeptTime) {
  request_.fast = false;
  request_.trials = 1;
  RecordedRun run(block(), stillHand(), options());
  (void)run.runTrial(kNeverStop);
  run.note("the phone rang");
  run.closeLog();
  run.closeLog();
  run.finish();
  EXPECT_TRUE(run.timing().starts_with("loop: ")) << run.timing();
  const record::RunLog log = logs().at(0);
  EXPECT_EQ(log.configuration().clock, "monotonic");
  EXPECT_EQ(test::eventsOf(log, record::EventKind::Note), (std::vector<std::string>{"the phone rang", run.timing()}));
}

}  // namespace
}  // namespace reachlab::session
