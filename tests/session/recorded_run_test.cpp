#include "sim/session/recorded_session.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>
#include <utility>

#include "base/ticks.h"
#include "base/fault.h"
#include "base/json_tree.h"
#include "sim/record/replay.h"
#include "sim/session/progress.h"
#include "tests/haptics/scripted_device.h"
#include "tests/record/made_run.h"

namespace reachlab::session {
namespace {

using haptics::test::MemorySink;
using haptics::test::ScriptedDevice;
using record::TemporaryFolder;

constexpr const char* kEasy = R"({ "schema_version": 1, "name": "easy", "constraint": { "name": "line", "shape": { "length_m": 0.2 } },
  "object": { "kind": "point", "masses_kg": [0.5], "stiffness_n_per_m": [] },
  "coupling": { "stiffness_n_per_m": 900, "damping_n_s_per_m": 40 },
  "task": { "start": [0], "target": [6.283185307179586], "duration_s": 0.4, "timeout_s": 0.1, "rest_s": 0,
            "tolerance": { "position_m": 0.05, "velocity_m_per_s": 5, "time_s": 0.3 } } })";

const std::atomic<bool> kNeverStop{false};

// A hand that moves in real time, or by tick count.
class Hand final : public haptics::HapticDevice {
 public:
  Hand(double to, bool isVirtual) : reach_(-0.1, to, 300), isVirtual_(isVirtual) {}
  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info = reach_.info();
    info.virtualHand = isVirtual_;
    info.version = "7";
    info.maxForce = 9;
    return info;
  }
  void cue(haptics::Cue cue) noexcept override { reach_.cue(cue); }
  haptics::DeviceSample read() noexcept override { return reach_.read(); }
  void write(const Vec3& force) noexcept override { reach_.write(force); }

 private:
  ScriptedDevice reach_;
  bool isVirtual_;
};

std::unique_ptr<haptics::HapticDevice> goodHand() { return std::make_unique<Hand>(0.1, true); }
std::unique_ptr<haptics::HapticDevice> stillHand() { return std::make_unique<Hand>(-0.1, true); }  // every trial is aborted: no onset

class Recorded : public testing::Test {
 protected:
  Recorded() {
    request_.place.data = folder_ / "data";
    request_.device = "scripted";
    request_.trials = 3;
    request_.seed = 1;
    request_.fast = true;
  }
  BlockToRun block() const { return planSession(request_, easy_).blocks.at(0); }
  RecordedRunOptions options() const {
    return {.place = request_.place, .numberAskedFor = request_.run.has_value(), .virtualClock = request_.fast};
  }
  Programme plan(const std::string& text) const {
    record::writeFileAtomically(folder_ / "easy.json", kEasy);
    record::writeFileAtomically(folder_ / "plan.json", text);
    return readProgramme(folder_ / "plan.json");
  }
  std::vector<record::RunLog> logs() const {
    std::vector<record::RunLog> logs;
    for (const RunOnDisk& run : recordedRuns(request_.place)) logs.push_back(record::RunLog::open(run.path));
    return logs;
  }

  TemporaryFolder folder_{"recorded"};
  SessionRequest request_;
  Programme easy_ = programmeOf(experiment::openExperimentText(kEasy, "easy.json"));
};

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
  EXPECT_EQ(c.deviceName, "scripted");
  EXPECT_EQ(c.deviceVersion, "7");
  EXPECT_EQ(c.deviceMaxForce, 9);
  EXPECT_TRUE(c.virtualHand);
  EXPECT_EQ(c.clock, "virtual");
  EXPECT_EQ(c.experimentName, "easy");
  EXPECT_EQ(c.table.massCount, 1);
}

// It renders force, so that its own facts are in the record, and it is never moved here.
class FeltHand final : public haptics::HapticDevice {
 public:
  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info;
    info.name = "felt";
    info.maxContinuousForce = 3;
    info.thermalSeconds = 20;
    info.virtualHand = info.rendersForce = true;
    info.mapping = R"({"scale":2})";
    return info;
  }
  haptics::DeviceSample read() noexcept override { return {}; }
  void write(const Vec3&) noexcept override {}
};

TEST_F(Recorded, WhatTheDeviceSaysOfItselfIsInTheLog) {
  RecordedRun(block(), std::make_unique<FeltHand>(), options()).finish();
  RecordedRun(block(), goodHand(), options()).finish();
  const record::RunConfiguration felt = logs().at(0).configuration(), shown = logs().at(1).configuration();
  EXPECT_TRUE(felt.rendersForce);
  EXPECT_FALSE(shown.rendersForce);
  EXPECT_EQ(felt.deviceContinuousForce, 3);
  EXPECT_EQ(felt.deviceThermalSeconds, 20);
  EXPECT_EQ(felt.deviceMapping, R"({"scale":2})");
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
  try {
    RecordedRun run(block(), std::make_unique<Hand>(0.1, false), options());
    FAIL();
  } catch (const FaultError& error) {
    EXPECT_EQ(error.faults.at(0).key, "fast");
    EXPECT_NE(error.faults.at(0).what.find("scripted"), std::string::npos);
  }
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

TEST_F(Recorded, ANoteIsKept) {
  RecordedRun run(block(), goodHand(), options());
  (void)run.runTrial(kNeverStop);
  run.note("the phone rang");
  run.finish();
  bool found = false;
  for (const record::RecordedEvent& event : logs().at(0).events()) found = found || event.text == "the phone rang";
  EXPECT_TRUE(found);
}

TEST_F(Recorded, AFolderThatRefusesIsAFaultOfTheDataset) {
  request_.place.data = "/dev/null/data";
  EXPECT_THROW(RecordedRun(block(), goodHand(), options()), DatasetError);
}

TEST_F(Recorded, InRealTimeTheLogSaysHowWellTheLoopKeptTime) {
  request_.fast = false;
  request_.trials = 1;
  RecordedRun run(block(), stillHand(), options());
  (void)run.runTrial(kNeverStop);
  run.closeLog();
  run.closeLog();
  run.finish();
  EXPECT_TRUE(run.timing().starts_with("loop: ")) << run.timing();
  const record::RunLog log = logs().at(0);
  EXPECT_EQ(log.configuration().clock, "monotonic");
  int notes = 0;
  for (const record::RecordedEvent& event : log.events()) notes += event.kind == record::EventKind::Note;
  EXPECT_EQ(notes, 1);
  EXPECT_EQ(log.events().back().text, run.timing());
}

struct Gaps {
  int count = 0;
  double milliseconds = 0;  // of each, beyond the tick's own
};

// Time that passes as the test says: no faster than the recorder can write, and with gaps in the movements. Watches the ticks to know when.
class Stalls final : public haptics::LoopClock, public haptics::RunSink {
 public:
  explicit Stalls(std::vector<Gaps> ofTrials, Gaps ofTheCheck = {}) : ofTrials_(std::move(ofTrials)), ofTheCheck_(ofTheCheck) {}

  std::int64_t now() noexcept override { return time_ += 1000; }
  void sleepUntil(std::int64_t deadline) noexcept override {
    std::this_thread::sleep_for(std::chrono::microseconds(50));
    time_ = std::max(time_, deadline) + std::exchange(stall_, 0);
  }
  bool onTick(const haptics::TickState& state, trial::Command, std::uint32_t) noexcept override {
    const bool checking = state.phase == trial::Phase::Idle;
    if (!checking && state.phase != trial::Phase::Moving) return true;
    if (state.tick % 5 != 0) return true;
    Gaps& gaps = checking ? ofTheCheck_ : ofTrials_.at(static_cast<std::size_t>(state.trial - 1));
    if (gaps.count-- > 0) stall_ = std::llround(gaps.milliseconds * 1e6) + 100'000;
    return true;
  }
  void announce(std::int32_t, const trial::PlannedTrial&) override {}
  void awaitTrial(std::int32_t) override {}
  void close() override {}

 private:
  std::vector<Gaps> ofTrials_;
  Gaps ofTheCheck_;
  std::int64_t time_ = 1'000'000'000, stall_ = 0;
};

class InRealTime : public Recorded {
 protected:
  InRealTime() { request_.fast = false; }
  RecordedRunOptions options(const std::shared_ptr<Stalls>& stalls, double checkSeconds = 0) const {
    RecordedRunOptions options = Recorded::options();
    options.clock = stalls;
    options.watchers = {stalls.get()};
    options.timingCheckSeconds = checkSeconds;
    return options;
  }
};

TEST_F(InRealTime, ATrialThatMissedTooMuchIsInterruptedAndPutUpOnceMoreIfTheBlockSaysSo) {
  const auto stalls = std::make_shared<Stalls>(std::vector<Gaps>{{6, 1}, {5, 1}, {1, 40}, {}, {1, 20}});
  BlockToRun wanted = block();
  wanted.configuration.repeatAborted = true;
  RecordedRun run(wanted, goodHand(), options(stalls));
  std::string told;
  while (const auto ended = run.runTrial(kNeverStop))
    told += std::to_string(ended->planned.index) + " " + std::string(nameOf(ended->result.outcome)) + " " +
            std::string(nameOf(ended->result.reason)) + "\n";
  EXPECT_EQ(told, "0 interrupted timing\n1 success none\n2 interrupted timing\n0 success none\n2 interrupted timing\n")
      << "five missed ticks are allowed; 2 is not put up a third time";
  run.finish();
  const std::string words = "longest gap ";
  ASSERT_NE(run.timing().find(words), std::string::npos);
  EXPECT_NEAR(std::stod(run.timing().substr(run.timing().find(words) + words.size())), 40, 2) << "[ms], the tick's own in it or not";
  std::vector<std::string> unreadable;
  const record::RunLog log = logs().at(0);
  ASSERT_EQ(log.trials().size(), 5u);
  const std::vector<std::uint64_t> missed{6, 5, 40, 0, 20};
  for (std::size_t i = 0; i < missed.size(); ++i) {
    const record::RecordedTrial& trial = log.trials()[i];
    EXPECT_EQ(trial.missedTicks, missed[i]) << i;
    const double ticks = static_cast<double>(trial.result.endTick - trial.goTick) * kTickSeconds;
    EXPECT_NEAR(trial.elapsed, ticks + static_cast<double>(missed[i]) * kTickSeconds, 1e-3) << "by the clock, within a tick";
  }
  EXPECT_TRUE(record::replayRun(log).identical()) << record::replayRun(log).firstDifference;
  EXPECT_EQ(readProgress(request_.place, unreadable).at(0).done, (std::set<int>{0, 1, 2}))
      << "--resume puts nothing up a third time, either";
}

TEST_F(InRealTime, TheExperimentSaysHowMuchAMovementMayMiss) {
  std::string text = kEasy;
  text.insert(text.find("\"task\""), R"("timing": { "max_missed_ticks": 100, "max_gap_s": 0.03 }, )");
  easy_ = programmeOf(experiment::openExperimentText(text, "easy.json"));
  const auto stalls = std::make_shared<Stalls>(std::vector<Gaps>{{10, 10}, {1, 29}, {1, 30}});
  RecordedRun run(block(), goodHand(), options(stalls));
  std::vector<trial::Reason> reasons;
  while (const auto ended = run.runTrial(kNeverStop)) reasons.push_back(ended->result.reason);
  EXPECT_EQ(reasons, (std::vector{trial::Reason::None, trial::Reason::None, trial::Reason::Timing}));
}

TEST_F(InRealTime, WhatWasRecordedBeforeThereWereLimitsIsReplayedWithoutThem) {
  {
    RecordedRun run(block(), goodHand(), Recorded::options());
    run.finish();
  }
  const record::RunConfiguration now = logs().at(0).configuration();
  EXPECT_EQ(record::recordedExperiment(now).experiment().timing.maxMissedTicks, 5);
  std::string text = record::toJson(now);
  const std::size_t key = text.find("\"timing\""), end = text.find("},", key);
  text.erase(key, end + 2 - key);
  const record::RunConfiguration before = record::configurationFromJson(text, "a log of before");
  EXPECT_EQ(record::recordedExperiment(before).experiment().timing.maxMissedTicks, experiment::kNoTimingLimits.maxMissedTicks);
  EXPECT_EQ(record::recordedExperiment(before).experiment().timing.maxGap, experiment::kNoTimingLimits.maxGap);
}

TEST_F(InRealTime, TheTimingIsCheckedBeforeTheFirstTrialAndTheVerdictIsKept) {
  for (const bool steady : {true, false}) {
    request_.run = steady ? 1 : 2;
    const auto stalls = std::make_shared<Stalls>(std::vector<Gaps>(3), Gaps{steady ? 0 : 4, 2});
    RecordedRun run(block(), goodHand(), options(stalls, 0.3));
    EXPECT_FALSE(run.timingVerdict());
    ASSERT_TRUE(run.putUpNext());  // as a window does
    EXPECT_TRUE(run.underWay());
    EXPECT_FALSE(run.putUpNext());
    EXPECT_EQ(run.trialsLeft(), 3u) << "not before it is checked";
    while (!run.poll()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_TRUE(run.timingVerdict());
    EXPECT_EQ(run.timingVerdict()->good, steady) << run.timingVerdict()->sentence;
    for (int looks = 0; looks < 20; ++looks, std::this_thread::sleep_for(std::chrono::milliseconds(1))) EXPECT_FALSE(run.poll());
    EXPECT_FALSE(run.underWay()) << "one trial was asked for, and the next is not put up by itself";
    EXPECT_EQ(run.trialsLeft(), 2u);
    while (run.runTrial(kNeverStop)) {}
    run.finish();
    const record::RunLog log = logs().at(steady ? 0 : 1);
    EXPECT_EQ(log.trials().size(), 3u);
    EXPECT_GE(log.trials()[0].startTick, 100u) << "0.3 s of the loop's clock, less the ticks that a busy machine misses";
    const std::vector<record::RecordedEvent> events = log.events();
    const auto isVerdict = [&](const record::RecordedEvent& event) { return event.text == run.timingVerdict()->sentence; };
    EXPECT_EQ(std::count_if(events.begin(), events.end(), isVerdict), 1);
    EXPECT_TRUE(record::replayRun(log).identical());
  }
}

// Says its last word when it is closed, as one does that sends a mark at the end.
class LastWord final : public record::InstrumentLink {
 public:
  bool onTick(const haptics::TickState&, trial::Command, std::uint32_t) noexcept override { return true; }
  void announce(std::int32_t, const trial::PlannedTrial&) override {}
  void awaitTrial(std::int32_t) override {}
  void close() override { events_.push_back({.kind = record::EventKind::Instrument, .text = "the last word"}); }
  std::string names() const override { return "last-word"; }
  void begin(const record::RunConfiguration&) override { events_.push_back({.kind = record::EventKind::Instrument, .text = "the first"}); }
  std::vector<record::RecordedEvent> takeEvents() override { return std::exchange(events_, {}); }
  std::vector<std::string> takeWarnings() override { return {}; }

 private:
  std::vector<record::RecordedEvent> events_;
};

TEST_F(InRealTime, WhatAnInstrumentSaysAtItsEndIsInTheLog) {
  LastWord instrument;
  RecordedRunOptions with = options(std::make_shared<Stalls>(std::vector<Gaps>(3)));
  with.instruments = &instrument;
  RecordedRun run(block(), goodHand(), with);
  ASSERT_TRUE(run.runTrial(kNeverStop));
  run.finish();
  std::string told;
  const record::RunLog log = logs().at(0);
  for (const record::RecordedEvent& event : log.events())
    if (event.kind == record::EventKind::Instrument) told += event.text + "; ";
  EXPECT_EQ(told, "the first; the last word; ");
  EXPECT_EQ(log.configuration().instruments, "last-word");
}

TEST_F(InRealTime, WhoAbortsDoesNotWaitForTheCheckAndWhoStopsNeither) {
  const auto stalls = std::make_shared<Stalls>(std::vector<Gaps>(3));
  RecordedRun run(block(), goodHand(), options(stalls, 3600));
  ASSERT_TRUE(run.putUpNext());
  run.abort();
  std::optional<haptics::ConductedTrial> ended;
  while (!(ended = run.poll())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(ended->result.outcome, trial::Outcome::Aborted);
  const std::atomic<bool> stop{true};
  EXPECT_EQ(run.runTrial(stop)->result.outcome, trial::Outcome::Interrupted);
  ASSERT_TRUE(run.putUpNext());
  run.finish();
  EXPECT_EQ(logs().at(0).trials().size(), 2u) << "the third was never put up";
}

class Conducted : public Recorded {
 protected:
  DeviceMaker maker(bool good = true) {
    return [this, good](const std::string& device, const experiment::CompiledExperiment& experiment, std::uint64_t seed) {
      made_.emplace_back(device + " " + experiment.experiment().name, seed);
      return good ? goodHand() : stillHand();
    };
  }
  SessionWords words() {
    SessionWords words;
    words.opened = [this](const RecordedRun& run) { told_.push_back("opened " + std::to_string(run.configuration().run)); };
    words.ended = [this](const RecordedRun& run, const haptics::ConductedTrial& trial) {
      told_.push_back(std::to_string(run.numberOf(trial)));
    };
    words.logClosed = [this](const RecordedRun& run) {
      told_.push_back(record::RunLog::open(run.logPath()).closed() ? "in order" : "open");
    };
    words.closed = [this](const RecordedRun&) { told_.push_back("closed"); };
    return words;
  }
  std::vector<std::pair<std::string, std::uint64_t>> made_;
  std::vector<std::string> told_;
};

constexpr const char* kTwoBlocks = R"({ "schema_version": 1, "trials": 2, "repeat_aborted": true, "blocks": [
  { "experiment": "easy.json", "condition": "a" }, { "experiment": "easy.json", "trials": 1, "condition": "b" } ] })";

TEST_F(Conducted, ASessionDoesItsBlocksInOrderAndSaysEachStep) {
  request_.trials.reset();
  RecordedSession session(plan(kTwoBlocks), request_, maker());
  EXPECT_EQ(session.blocksLeft(), 2u);
  EXPECT_EQ(session.seed(), 1u);
  EXPECT_FALSE(session.notice().seedDrawn);
  EXPECT_EQ(session.run(), nullptr);
  EXPECT_TRUE(conduct(session, kNeverStop, words()));
  EXPECT_EQ(told_, (std::vector<std::string>{"opened 1", "1", "2", "in order", "closed", "opened 2", "1", "in order", "closed"}));
  ASSERT_EQ(made_.size(), 2u);
  EXPECT_EQ(made_[0].first, "scripted easy");
  const std::vector<record::RunLog> found = logs();
  ASSERT_EQ(found.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(made_[k].second, found[k].configuration().seed);
    EXPECT_EQ(found[k].configuration().condition, k == 0 ? "a" : "b");
  }
  EXPECT_FALSE(session.openNext());
  EXPECT_EQ(session.run(), nullptr);
}

TEST_F(Conducted, AStopKeepsTheTrialAsInterruptedAndLeavesTheRestToBeResumed) {
  request_.trials.reset();
  const Programme programme = plan(kTwoBlocks);
  {
    RecordedSession session(programme, request_, maker());
    std::atomic<bool> stop{false};
    SessionWords said = words();
    said.ended = [&](const RecordedRun&, const haptics::ConductedTrial&) { stop = true; };
    EXPECT_FALSE(conduct(session, stop, said));
    EXPECT_EQ(session.blocksLeft(), 1u);
  }
  {
    request_.resume = true;
    RecordedSession session(programme, request_, maker());
    EXPECT_EQ(session.blocksLeft(), 2u);
    const std::atomic<bool> stop{true};
    EXPECT_FALSE(conduct(session, stop, words()));
  }
  std::vector<record::RunLog> found = logs();
  ASSERT_EQ(found.size(), 2u);
  ASSERT_EQ(found[1].trials().size(), 1u);
  EXPECT_EQ(found[1].trials()[0].result.outcome, trial::Outcome::Interrupted);
  EXPECT_TRUE(found[1].closed());
  RecordedSession session(programme, request_, maker());
  EXPECT_TRUE(conduct(session, kNeverStop, words()));
  found = logs();
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[2].configuration().firstRun, 1);
  ASSERT_EQ(found[2].trials().size(), 1u);
  EXPECT_EQ(found[2].trials()[0].trial, 2);
  EXPECT_EQ(found[2].trials()[0].planned.index, 1);
  EXPECT_EQ(found[3].configuration().condition, "b");
  EXPECT_EQ(RecordedSession(programme, request_, maker()).blocksLeft(), 0u);
}

// Pulled out in the first movement.
class LostHand final : public haptics::HapticDevice {
 public:
  haptics::DeviceInfo info() const override { return reach_.info(); }
  haptics::DeviceHealth health() const noexcept override { return isLost() ? haptics::DeviceHealth::Lost : haptics::DeviceHealth::Ready; }
  void cue(haptics::Cue cue) noexcept override { reach_.cue(cue); }
  haptics::DeviceSample read() noexcept override {
    if (!isLost()) last_ = reach_.read();
    ++reads_;
    last_.valid = !isLost();
    return last_;
  }
  void write(const Vec3& force) noexcept override { reach_.write(force); }

 private:
  bool isLost() const { return reads_ >= 100; }
  ScriptedDevice reach_{-0.1, 0.1, 300};
  haptics::DeviceSample last_;
  std::atomic<int> reads_{0};
};

TEST_F(Conducted, ALostDeviceEndsTheRunWithTheTrialItWasLostIn) {
  RecordedSession session(easy_, request_, [](const std::string&, const experiment::CompiledExperiment&, std::uint64_t) {
    return std::unique_ptr<haptics::HapticDevice>(std::make_unique<LostHand>());
  });
  EXPECT_THROW(conduct(session, kNeverStop, words()), ResourceError);
  EXPECT_EQ(told_, (std::vector<std::string>{"opened 1", "1", "in order", "closed"}));
  EXPECT_EQ(logs().at(0).trials().at(0).result.outcome, trial::Outcome::Interrupted);
}

TEST_F(Conducted, ABlockWhoseDeviceCannotBeHadIsStillLeft) {
  RecordedSession session(easy_, request_,
                          [](const std::string&, const experiment::CompiledExperiment&,
                             std::uint64_t) -> std::unique_ptr<haptics::HapticDevice> { throw ResourceError("not plugged in"); });
  EXPECT_THROW(session.openNext(), ResourceError);
  EXPECT_EQ(session.blocksLeft(), 1u);
  EXPECT_TRUE(recordedRuns(request_.place).empty());
}

TEST_F(Conducted, OpeningTheNextRunFinishesTheOneBefore) {
  request_.trials.reset();
  RecordedSession session(plan(kTwoBlocks), request_, maker());
  ASSERT_TRUE(session.openNext());
  ASSERT_TRUE(session.run()->putUpNext());
  ASSERT_TRUE(session.openNext());
  EXPECT_EQ(session.run()->configuration().condition, "b");
  EXPECT_TRUE(record::RunLog::open(recordedRuns(request_.place).at(0).path).closed());
  session.closeRun();
  EXPECT_EQ(session.run(), nullptr);
}

TEST_F(Conducted, TheSessionSaysWhatIsWorthAWord) {
  request_.seed.reset();
  {
    RecordedSession session(easy_, request_, maker());
    EXPECT_TRUE(session.notice().seedDrawn);
    EXPECT_FALSE(session.notice().unfinished);
    session.openNext();
    (void)session.run()->runTrial(kNeverStop);
  }
  EXPECT_TRUE(RecordedSession(easy_, request_, maker()).notice().unfinished);
  request_.resume = true;
  const RecordedSession resumed(easy_, request_, maker());
  EXPECT_FALSE(resumed.notice().unfinished);
  EXPECT_FALSE(resumed.notice().seedDrawn);
}

TEST_F(Conducted, ARestIsSaidWhereThePlanHasOneAndSomebodyWaits) {
  request_.trials.reset();
  const Programme rested = plan(R"({ "schema_version": 1, "trials": 1, "blocks": [ { "experiment": "easy.json", "rest_s": 3600 },
      { "experiment": "easy.json", "condition": "b", "rest_s": 0.05 }, { "experiment": "easy.json", "condition": "c" } ] })");
  SessionWords said = words();
  said.resting = [this](const BlockToRun& next) { told_.push_back("rest before " + next.configuration.condition); };
  said.checked = [this](const RecordedRun&) { told_.emplace_back("checked"); };
  const auto tellsOf = [&](const std::string& subject, bool fast, double checkSeconds) {
    told_.clear();
    request_.place.subject = subject;
    request_.fast = fast;
    request_.timingCheckSeconds = checkSeconds;
    RecordedSession session(rested, request_, maker(fast));
    EXPECT_TRUE(conduct(session, kNeverStop, said));
    return told_;
  };
  const std::vector<std::string> fast{"opened 1", "1",      "in order", "closed", "opened 2", "1",
                                      "in order", "closed", "opened 3", "1",      "in order", "closed"};
  EXPECT_EQ(tellsOf("01", true, 0.05), fast) << "on the virtual clock nobody rests, and there is no timing to check";
  EXPECT_EQ(tellsOf("02", false, 0.05),
            (std::vector<std::string>{"opened 1", "checked", "1", "in order", "closed", "rest before b", "opened 2", "checked", "1",
                                      "in order", "closed", "opened 3", "checked", "1", "in order", "closed"}))
      << "none before the first block, which begins when it is begun";
  std::erase_if(told_, [](const std::string& word) { return word == "checked"; });
  const std::vector<std::string> unchecked = told_;
  EXPECT_EQ(tellsOf("03", false, 0), unchecked);
}

TEST_F(Conducted, AStopInARestLeavesTheNextBlockToBeResumed) {
  request_.fast = false;
  request_.trials.reset();
  RecordedSession session(plan(R"({ "schema_version": 1, "trials": 1, "blocks": [ { "experiment": "easy.json" },
      { "experiment": "easy.json", "condition": "b", "rest_s": 3600 } ] })"),
                          request_, maker(false));
  std::atomic<bool> stop{false};
  SessionWords said = words();
  said.resting = [&](const BlockToRun&) { stop = true; };
  EXPECT_FALSE(conduct(session, stop, said));
  EXPECT_EQ(session.blocksLeft(), 1u);
  EXPECT_EQ(logs().size(), 1u);
}

// Lower bounds alone: however slow the machine is, rest and pause are not shorter.
TEST_F(Conducted, ThePlansRestLiesBetweenBlocksInRealTime) {
  request_.fast = false;
  request_.trials.reset();
  RecordedSession session(plan(R"({ "schema_version": 1, "trials": 1, "blocks": [ { "experiment": "easy.json" },
      { "experiment": "easy.json", "condition": "b", "rest_s": 0.3 } ] })"),
                          request_, maker(false));
  std::chrono::steady_clock::time_point rests, opened;
  SessionWords said = words();
  said.resting = [&](const BlockToRun&) { rests = std::chrono::steady_clock::now(); };
  said.opened = [&](const RecordedRun&) { opened = std::chrono::steady_clock::now(); };
  EXPECT_TRUE(conduct(session, kNeverStop, said));
  EXPECT_GE(opened - rests, std::chrono::milliseconds(300));
}

// A person's hand that lies somewhere else than at the start.
class HandElsewhere final : public haptics::HapticDevice {
 public:
  haptics::DeviceInfo info() const override { return {}; }
  haptics::DeviceSample read() noexcept override { return {.position = {0.05, 0, 0}}; }
  void write(const Vec3&) noexcept override {}
};

TEST_F(Conducted, ATrialThatWaitsForItsHandIsSaidToWait) {
  request_.fast = false;
  request_.trials = 1;
  RecordedSession session(easy_, request_, [](const auto&...) { return std::make_unique<HandElsewhere>(); });
  std::atomic<bool> stop{false};
  SessionWords said = words();
  said.waiting = [&](const RecordedRun& run) {
    EXPECT_EQ(run.latest().phase, trial::Phase::Waiting);
    EXPECT_EQ(run.latest().device.position, Vec3(0.05, 0, 0));
    told_.emplace_back("waiting");
    stop = true;
  };
  const std::jthread unsaid([&](const std::stop_token& over) {  // else it would wait for ever
    for (int i = 0; i < 6000 && !over.stop_requested(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    stop = true;
  });
  EXPECT_FALSE(conduct(session, stop, said));
  EXPECT_EQ(told_, (std::vector<std::string>{"opened 1", "waiting", "1", "in order", "closed"}));
}

// Lower bounds alone: however slow the machine is, the pause is not shorter.
TEST_F(Conducted, ThePlansPauseLiesBetweenTrialsInRealTime) {
  request_.fast = false;
  request_.trials.reset();
  RecordedSession session(plan(R"({ "schema_version": 1, "trials": 2, "pause_s": 0.3, "blocks": [ { "experiment": "easy.json" } ] })"),
                          request_, maker(false));
  EXPECT_TRUE(conduct(session, kNeverStop, words()));
  const record::RunLog log = logs().at(0);
  ASSERT_EQ(log.trials().size(), 2u);
  std::int64_t ended = 0, begun = 0;
  for (const record::RecordedTick& tick : log.ticks()) {
    if (tick.tick == log.trials()[0].result.endTick) ended = tick.measuredNs;
    if (tick.tick == log.trials()[1].startTick) begun = tick.measuredNs;
  }
  EXPECT_GE(begun - ended, 300'000'000);
}

TEST(ProgrammeOfASession, CompilesEachExperimentOfAPlanOnce) {
  const TemporaryFolder folder("programme");
  record::writeFileAtomically(folder / "p.json", R"({ "schema_version": 1, "trials": 1, "blocks": [
      { "experiment": "chain-slow" }, { "experiment": "epitrochoid" }, { "experiment": "chain-slow" } ] })");
  const Programme programme = readProgramme(folder / "p.json");
  EXPECT_TRUE(programme.isPlan());
  ASSERT_EQ(programme.experiments.size(), 3u);
  EXPECT_EQ(&programme.experiments[0].experiment(), &programme.experiments[2].experiment());
  EXPECT_EQ(programme.experiments[1].experiment().name, "epitrochoid");
  EXPECT_FALSE(readProgramme("chain-slow").isPlan());
  EXPECT_THROW(readProgramme("chain-slo"), FaultError);
}

}  // namespace
}  // namespace reachlab::session
