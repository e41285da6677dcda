#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>
#include <utility>

#include "base/ticks.h"
#include "sim/experiment/experiment.h"
#include "sim/record/replay.h"
#include "sim/session/recorded_blocks.h"
#include "tests/session/recorded_runs.h"

// A run in real time: what its loop missed, the check of that before the first trial, and what stands beside the device.
namespace reachlab::session {
namespace {

using test::goodHand;
using test::kEasy;
using test::kNeverStop;
using test::Recorded;

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
  EXPECT_EQ(readRecordedBlocks(request_.place, unreadable).at(0).done, (std::set<int>{0, 1, 2}))
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
  const record::RunLog log = logs().at(0);
  EXPECT_EQ(test::eventsOf(log, record::EventKind::Instrument), (std::vector<std::string>{"the first", "the last word"}));
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
  EXPECT_FALSE(run.runTrial(stop)) << "nobody saw a trial";
  ASSERT_TRUE(run.putUpNext());
  run.finish();
  EXPECT_EQ(logs().at(0).trials().size(), 1u) << "the others were never put up";
}

}  // namespace
}  // namespace reachlab::session
