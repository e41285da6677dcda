#include "sim/session/recorded_session.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "tests/haptics/set_device.h"
#include "tests/session/recorded_runs.h"

// A session's runs, one after the other, with what is said and waited for between them.
namespace reachlab::session {
namespace {

using haptics::test::SetDevice;
using test::goodHand;
using test::kEasy;
using test::kNeverStop;
using test::Recorded;
using test::stillHand;

class Conducted : public Recorded {
 protected:
  Programme plan(const std::string& text) {
    request_.trials.reset();
    folder_.write("easy.json", kEasy);
    return readProgramme(folder_.write("plan.json", text));
  }
  /// Two blocks of one trial each.
  Programme planWithRest(double seconds) {
    return plan(R"({ "schema_version": 1, "trials": 1, "blocks": [ { "experiment": "easy.json" },
      { "experiment": "easy.json", "condition": "b", "rest_s": )" +
                std::to_string(seconds) + " } ] }");
  }
  DeviceMaker maker(bool good = true) {
    return [this, good](const std::string& device, std::span<const experiment::CompiledExperiment> scenes, std::uint64_t seed) {
      made_.emplace_back(device + " " + scenes.front().experiment().name, seed);
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
    words.closed = [this] { told_.push_back("closed"); };
    return words;
  }
  std::vector<std::pair<std::string, std::uint64_t>> made_;
  std::vector<std::string> told_;
};

constexpr const char* kTwoBlocks = R"({ "schema_version": 1, "trials": 2, "repeat_aborted": true, "blocks": [
  { "experiment": "easy.json", "condition": "a" }, { "experiment": "easy.json", "trials": 1, "condition": "b" } ] })";

TEST_F(Conducted, ASessionDoesItsBlocksInOrderAndSaysEachStep) {
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

TEST_F(Conducted, AStopBeforeATrialRecordsNoneAndLeavesTheRestToBeResumed) {
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
    std::atomic<bool> stop{true};  // as after a signal while the tables of a block were written
    EXPECT_FALSE(conduct(session, stop, words()));
    EXPECT_EQ(logs().size(), 1u) << "no run begins";
    stop = false;
    SessionWords said = words();
    said.opened = [&](const RecordedRun&) { stop = true; };
    EXPECT_FALSE(conduct(session, stop, said));
  }
  std::vector<record::RunLog> found = logs();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[1].trials().empty()) << "nobody saw a trial of it";
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

TEST_F(Conducted, ALostDeviceEndsTheRunWithTheTrialItWasLostIn) {
  RecordedSession session(easy_, request_, [](const auto&...) {
    auto hand = std::make_unique<SetDevice>(Vec3{-0.1, 0, 0});
    hand->about.virtualHand = true;
    hand->whileItIsRead = [own = hand.get()] {
      if (own->reads < 50) return;  // it is pulled out in the trial
      own->sample.valid = false;
      own->is = haptics::DeviceHealth::Lost;
    };
    return hand;
  });
  EXPECT_THROW(conduct(session, kNeverStop, words()), ResourceError);
  EXPECT_EQ(told_, (std::vector<std::string>{"opened 1", "1", "in order", "closed"}));
  EXPECT_EQ(logs().at(0).trials().at(0).result.outcome, trial::Outcome::Interrupted);
}

TEST_F(Conducted, ABlockWhoseDeviceCannotBeHadIsStillLeft) {
  RecordedSession session(easy_, request_,
                          [](const auto&...) -> std::unique_ptr<haptics::HapticDevice> { throw ResourceError("not plugged in"); });
  EXPECT_THROW(session.openNext(), ResourceError);
  EXPECT_EQ(session.blocksLeft(), 1u);
  EXPECT_TRUE(recordedRuns(request_.place).empty());
}

TEST_F(Conducted, OpeningTheNextRunFinishesTheOneBefore) {
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
  RecordedSession session(planWithRest(3600), request_, maker(false));
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
  RecordedSession session(planWithRest(0.3), request_, maker(false));
  std::chrono::steady_clock::time_point ended, opened;
  SessionWords said = words();
  said.ended = [&](const RecordedRun& run, const haptics::ConductedTrial&) {
    if (run.configuration().block == 1) ended = std::chrono::steady_clock::now();
  };
  said.opened = [&](const RecordedRun&) { opened = std::chrono::steady_clock::now(); };
  EXPECT_TRUE(conduct(session, kNeverStop, said));
  EXPECT_GE(opened - ended, std::chrono::milliseconds(300));
}

// A person's hand lies somewhere else than at the start.
TEST_F(Conducted, ATrialThatWaitsForItsHandIsSaidToWait) {
  request_.fast = false;
  request_.trials = 1;
  RecordedSession session(easy_, request_, [](const auto&...) { return std::make_unique<SetDevice>(Vec3{0.05, 0, 0}); });
  std::atomic<bool> stop{false};
  SessionWords said = words();
  said.waiting = [&](const RecordedRun& run) {
    EXPECT_EQ(run.latest().phase, trial::Phase::Waiting);
    EXPECT_EQ(run.latest().hands[0].device.position, Vec3(0.05, 0, 0));
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
  const TemporaryFolder folder;
  const Programme programme = readProgramme(folder.write("p.json", R"({ "schema_version": 1, "trials": 1, "blocks": [
      { "experiment": "chain-slow" }, { "experiment": "epitrochoid" }, { "experiment": "chain-slow" } ] })"));
  EXPECT_TRUE(programme.isPlan());
  ASSERT_EQ(programme.experiments.size(), 3u);
  EXPECT_EQ(&programme.experiments[0].experiment(), &programme.experiments[2].experiment());
  EXPECT_EQ(programme.experiments[1].experiment().name, "epitrochoid");
  EXPECT_FALSE(readProgramme("chain-slow").isPlan());
  EXPECT_THROW(readProgramme("chain-slo"), FaultError);
}

}  // namespace
}  // namespace reachlab::session
