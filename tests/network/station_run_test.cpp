#include "network/station/station_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <thread>

#include "base/fault.h"
#include "base/system/os.h"
#include "sim/session/session.h"
#include "tests/haptics/scripted_device.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

// One station's trials, with the test in the endpoint's place: it writes what the network would have brought.
namespace reachlab::network {
namespace {

using Words = std::vector<std::string>;

class OneStation : public testing::Test {
 protected:
  void open(int number, bool conductor, double wait = 60, const std::string& what = "chain-two-hands") {
    session::SessionRequest request;
    request.what = what;
    request.device = "resting";
    request.place.data = folder_ / "data";
    request.seed = 1;
    request.trials = 3;
    request.everyTick = true;
    StationSetup setup;
    setup.link.station = number;
    setup.link.conductor = conductor;
    setup.link.endpoint = folder_.writeProgram("endpoint", "echo $$ > \"$0.pid\"\nexec sleep 60");
    setup.link.name = "here";
    setup.link.software = software_;
    setup.link.device = device_;
    setup.wait = wait;
    const session::BlockToRun block = session::planSession(request, session::readProgramme(request.what)).blocks.at(0);
    station_ = std::make_unique<StationRun>(setup, block.experiment);
    session::RecordedRunOptions options;
    options.place = request.place;
    station_->prepare(options);
    run_ = std::make_unique<session::RecordedRun>(block, std::make_unique<haptics::test::ScriptedDevice>(-0.1, -0.1, 1), options);
    station_->begin(*run_);
    hash_ = sharedHash(block.experiment.experiment());
  }
  // The test in the endpoint's place does not read that it is to end, and is not waited for.
  void endEndpoint() {
    int process = 0;
    if (std::ifstream(folder_ / "endpoint.pid") >> process) ::kill(process, SIGKILL);
  }
  void close() {
    endEndpoint();
    if (station_) (void)station_->close();
  }
  void TearDown() override {
    close();
    run_.reset();
    station_.reset();
  }
  LinkMemory& memory() { return station_->link().memory(); }
  StationCard cardOf(std::uint32_t number) const {
    StationCard card;
    card.station = number;
    card.version = LinkMemory::kVersion;
    card.experiment = hash_;
    std::strcpy(card.software.data(), "reachlab");
    return card;
  }
  void showCard(std::uint32_t number, bool conductor) {
    StationCard card = cardOf(number);
    card.conductor = conductor;
    ASSERT_TRUE(memory().cardsIn.tryPush(card));
  }
  void hear(std::uint32_t number, double roundTrip) {
    LinkStatus& status = memory().status[number - 1];
    status.roundTrip.store(roundTrip);
    status.lossBound.store(status.loss.load());
    status.heardNs.store(os::now());
  }
  void tell(std::uint32_t number, LinkEvent::Kind kind, std::int32_t trial, trial::Outcome outcome = trial::Outcome::None) {
    LinkEvent event;
    event.outcome = outcome;
    event.station = number;
    event.kind = kind;
    event.trial = trial;
    ASSERT_TRUE(memory().eventsIn.tryPush(event));
  }
  // All that happens until it is as wanted, or for so long.
  StationNews pollUntil(const std::function<bool(const StationNews&)>& wanted, double seconds = 2) {
    StationNews all;
    const std::int64_t until = os::now() + static_cast<std::int64_t>(1e9 * seconds);
    while (os::now() < until && !wanted(all)) {
      const StationNews news = station_->poll();
      all.words.insert(all.words.end(), news.words.begin(), news.words.end());
      all.begun = all.begun || news.begun;
      all.finished = all.finished || news.finished;
      if (!news.notArmed.empty()) all.notArmed = news.notArmed;
      if (news.ended) all.ended = news.ended;
      if (!news.problem.empty()) all.problem = news.problem;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return all;
  }
  // A station's samples of the first trial, a millisecond apart.
  std::jthread sendFrom(std::size_t station) {
    return std::jthread([this, station](const std::stop_token& over) {
      HeardState heard;
      heard.trial = 1;
      heard.sample.hand = {-0.1, 0, 0};  // at the start, where the object is
      for (std::uint32_t sequence = 1; !over.stop_requested(); ++sequence) {
        heard.roundTrip = 0.01 + 1e-5 * (sequence % 100);
        heard.sample.sequence = sequence;
        heard.sample.time = 1e-9 * static_cast<double>(os::now());
        (void)memory().in[station - 1].tryPush(heard);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }
  StationStatus statusNow() {
    station_->keep();
    return station_->link().statuses().at(0);
  }
  // The same while station 2 is heard, until a trial has begun or cannot.
  StationNews pollWhileHeard(double roundTrip, double seconds = 2) {
    const auto wanted = [&](const StationNews& news) {
      hear(2, roundTrip);
      return news.begun || !news.problem.empty();
    };
    return pollUntil(wanted, seconds);
  }
  static bool never(const StationNews&) { return false; }
  static bool begun(const StationNews& news) { return news.begun; }
  static bool ended(const StationNews& news) { return news.ended.has_value(); }
  static bool finished(const StationNews& news) { return news.finished; }
  static bool isTwoWords(const StationNews& news) { return news.words.size() >= 2; }
  // Station 2, told by the conductor to put up the first trial.
  void beginAsFollower() {
    open(2, false);
    showCard(1, true);
    tell(1, LinkEvent::Kind::Arm, 1);
    EXPECT_TRUE(pollUntil(begun).begun);
  }
  std::optional<LinkEvent> sent(LinkEvent::Kind kind) {
    for (LinkEvent event; memory().eventsOut.tryPop(event);)
      if (event.kind == kind) return event;
    return std::nullopt;
  }
  bool noted(const std::string& words) {
    for (const record::RecordedEvent& event : record::RunLog::open(run_->logPath()).events())
      if (event.text.find(words) != std::string::npos) return true;
    return false;
  }

  const TemporaryFolder folder_;
  std::unique_ptr<StationRun> station_;
  std::unique_ptr<session::RecordedRun> run_;
  std::uint64_t hash_ = 0;
  std::string software_ = "reachlab", device_ = "resting";
};

TEST_F(OneStation, LongNamesAreShownAsFarAsACardHoldsThem) {
  software_ = device_ = std::string(1000, 'x');
  EXPECT_NO_THROW(open(1, true));
}

TEST_F(OneStation, OnlyTheConductorsWordCounts) {
  open(2, false);
  tell(1, LinkEvent::Kind::Arm, 1);
  EXPECT_FALSE(pollUntil(begun, 0.3).begun) << "nobody has said yet who station 1 is";
  showCard(1, false);
  const StationNews refused = pollUntil(begun, 0.3);
  EXPECT_FALSE(refused.begun);
  ASSERT_EQ(refused.words.size(), 1u);
  EXPECT_TRUE(holds(refused.words[0], "station 1 is not the conductor"));
  tell(1, LinkEvent::Kind::Finish, 1);
  EXPECT_FALSE(pollUntil(finished, 0.2).finished);
}

TEST_F(OneStation, AFollowerPutsUpWhatTheConductorArmsAndEndsWhenItIsTold) {
  open(2, false);
  tell(1, LinkEvent::Kind::Arm, 1);
  EXPECT_FALSE(pollUntil(begun, 0.1).begun);
  showCard(1, true);
  EXPECT_TRUE(pollUntil(begun).begun) << "what was told before its card came is done";
  EXPECT_FALSE(pollUntil(begun, 0.2).begun) << "once";
  tell(1, LinkEvent::Kind::Interrupt, 1);
  const StationNews news = pollUntil(ended);
  ASSERT_TRUE(news.ended);
  EXPECT_EQ(news.ended->result.reason, trial::Reason::Experimenter);
  EXPECT_FALSE(news.finished) << "another trial may follow";
  tell(1, LinkEvent::Kind::Arm, 2);
  EXPECT_TRUE(pollUntil(begun).begun);
  tell(1, LinkEvent::Kind::Finish, 2);
  EXPECT_TRUE(pollUntil(finished).finished) << "a trial that waits for its hand ends; without an end it would hold the station";
}

TEST_F(OneStation, ATrialThatIsOverForTheOthersIsNotPutUp) {
  open(2, false);
  showCard(1, true);
  tell(1, LinkEvent::Kind::Arm, 4);
  tell(1, LinkEvent::Kind::Ended, 4);
  EXPECT_FALSE(pollUntil(begun, 0.3).begun);
  tell(1, LinkEvent::Kind::Arm, 5);
  EXPECT_TRUE(pollUntil(begun).begun);
}

TEST_F(OneStation, TheConductorArmsWhenEveryLineIsGoodAndSaysWhyNot) {
  open(1, true, 1);
  station_->armNext();
  const StationNews alone = pollUntil([](const StationNews& news) { return !news.problem.empty(); }, 3);
  EXPECT_EQ(alone.notArmed, "station 2: is not there");
  EXPECT_EQ(alone.problem, "no trial was armed: station 2: is not there");
  EXPECT_FALSE(station_->isArming()) << "it is asked again";
  showCard(2, false);
  hear(2, 0.2);
  station_->armNext();
  const StationNews slow = pollUntil([](const StationNews& news) { return !news.notArmed.empty(); });
  EXPECT_EQ(slow.notArmed, "station 2: a round trip takes 200 ms; allowed: up to 120");
  EXPECT_TRUE(pollWhileHeard(0.002).begun);
  const std::optional<LinkEvent> arm = sent(LinkEvent::Kind::Arm);
  ASSERT_TRUE(arm);
  EXPECT_EQ(arm->frequency, 3) << "a chain's, which the check before the block has found to do";
  station_->stop();
  EXPECT_TRUE(pollUntil(finished).finished);
  EXPECT_TRUE(sent(LinkEvent::Kind::Finish));
  close();
  EXPECT_TRUE(noted("simulated with limp hands over this link (round trip 2.0 ms")) << "what was checked is in the log";
}

// It was killed in mid-run. The others have ended seven trials and prepare none of these again.
TEST_F(OneStation, AConductorThatIsStartedAgainCountsOn) {
  open(1, true);
  showCard(2, false);
  tell(2, LinkEvent::Kind::Ended, 7);
  station_->armNext();
  EXPECT_TRUE(pollWhileHeard(0.002).begun);
  EXPECT_EQ(sent(LinkEvent::Kind::Arm).value_or(LinkEvent{}).trial, 8);
}

// The rod is stiffer than what the design was studied with: 100 ms are within what a link may take, and too much for it.
TEST_F(OneStation, NothingIsArmedThatWouldNotComeToRestOverThisLine) {
  open(1, true, 2, "body-two-hands");
  showCard(2, false);
  station_->armNext();
  const StationNews refused = pollWhileHeard(0.1, 5);
  EXPECT_FALSE(refused.begun);
  EXPECT_TRUE(refused.problem.starts_with("no trial was armed: simulated with limp hands over this link (round trip 100.0 ms"))
      << refused.problem;
  EXPECT_FALSE(sent(LinkEvent::Kind::Arm));
  EXPECT_FALSE(station_->isArming());
}

// The loop runs on while the log is being closed, and samples come on.
TEST_F(OneStation, WhatIsGivenToTheCopyLastIsInTheLogToo) {
  beginAsFollower();
  std::jthread other = sendFrom(1);
  (void)pollUntil(never, 0.3);
  close();
  other.request_stop();
  other.join();
  const record::RunLog log = record::RunLog::open(run_->logPath());
  EXPECT_GT(givenSamples(log).size(), 100u);
  const record::Replay replay = replayStation(log);
  EXPECT_TRUE(replay.identical()) << replay.firstDifference;
}

TEST_F(OneStation, TheConductorsOutcomeIsKeptBesideWhatTheCopyHereCameTo) {
  beginAsFollower();
  tell(1, LinkEvent::Kind::Interrupt, 1);
  EXPECT_TRUE(pollUntil(ended).ended);
  tell(1, LinkEvent::Kind::Ended, 1, trial::Outcome::Interrupted);
  const StationNews told = pollUntil(isTwoWords);
  ASSERT_EQ(told.words.size(), 2u);
  EXPECT_EQ(told.words[1], "trial 1: interrupted by the conductor's copy, which counts; aborted (experimenter) by the copy here");
  close();
  EXPECT_TRUE(noted("trial 1: outcome interrupted by the conductor, station 1; aborted (experimenter) here, where the copies were"));
}

// The other stood still for a moment, which ended its trial, and goes on sending. Its word comes in mid-trial or after the end.
TEST_F(OneStation, ATrialThatAnyStationBrokeOffIsBrokenOffForAll) {
  beginAsFollower();
  const std::jthread other = sendFrom(1);
  tell(1, LinkEvent::Kind::Ended, 1, trial::Outcome::Interrupted);
  const StationNews news = pollUntil(ended);
  ASSERT_TRUE(news.ended);
  EXPECT_EQ(news.ended->result.reason, trial::Reason::PeerLost);
}

TEST_F(OneStation, AWordThatComesAfterTheEndBreaksTheTrialOffForAll) {
  beginAsFollower();
  tell(1, LinkEvent::Kind::Interrupt, 1);
  EXPECT_TRUE(pollUntil(ended).ended);
  tell(1, LinkEvent::Kind::Ended, 1, trial::Outcome::Success);
  const StationNews told = pollUntil(isTwoWords, 0.5);
  ASSERT_EQ(told.words.size(), 1u) << "the outcome is aborted at both";
  close();
  EXPECT_TRUE(noted("trial 1: outcome aborted (experimenter) by the one that broke it off, station 2; aborted (experimenter) here"));
}

TEST_F(OneStation, ALinkThatLosesMoreThanAFifthStandsInTheWay) {
  using Light = StationStatus::Light;
  open(1, true);
  showCard(2, false);
  LinkStatus& link = memory().status[1];
  const auto status = [&](double loss, double overtaken, double bound) {
    link.loss.store(loss), link.overtaken.store(overtaken);
    hear(2, 0.002);
    link.lossBound.store(bound);
    return statusNow();
  };
  EXPECT_EQ(status(0, 0.76, 0.03).light, Light::Good) << "what is overtaken is not lost";
  EXPECT_EQ(status(0.11, 0, 0.16).light, Light::Fair);
  EXPECT_EQ(status(0.13, 0, 0.2).obstacles, Words{});
  EXPECT_EQ(status(0.15, 0, 0.21).obstacles, Words{"how much of what it sends is lost is not known well enough yet; allowed: up to 20 %"});
  EXPECT_EQ(status(0.21, 0, 0.3).obstacles, Words{"21 % of what it sends is lost; allowed: up to 20"});
}

TEST_F(OneStation, StatusesSayHowGoodALineIs) {
  using Light = StationStatus::Light;
  open(1, true);
  EXPECT_EQ(statusNow().light, Light::Absent);
  showCard(2, false);
  EXPECT_EQ(statusNow().light, Light::Stop) << "it sends nothing";
  hear(2, 0.002);
  EXPECT_EQ(statusNow().light, Light::Good);
  EXPECT_TRUE(statusNow().heard);
  hear(2, 0.08);
  EXPECT_EQ(statusNow().light, Light::Fair);
  hear(2, 0.13);
  EXPECT_EQ(statusNow().light, Light::Stop);
  EXPECT_EQ(statusNow().obstacles, Words{"a round trip takes 130 ms; allowed: up to 120"});
}

// What stands on a station's card is held against this one's, and each difference is said.
TEST_F(OneStation, ACardThatDoesNotFitIsSaidWithBothSides) {
  open(1, true);
  const auto obstaclesOf = [&](const std::function<void(StationCard&)>& change) {
    StationCard card = cardOf(2);
    change(card);
    EXPECT_TRUE(memory().cardsIn.tryPush(card));
    hear(2, 0.002);
    return statusNow().obstacles;
  };
  EXPECT_EQ(obstaclesOf([](StationCard&) {}), Words{});
  EXPECT_EQ(obstaclesOf([](StationCard& card) { card.conductor = true; }), Words{"is a conductor too"});
  EXPECT_EQ(obstaclesOf([](StationCard& card) { std::strcpy(card.software.data(), "reachlab 0.1"); }),
            Words{"runs reachlab 0.1, and this one reachlab"});
  EXPECT_EQ(obstaclesOf([](StationCard& card) { ++card.version; }).at(0).substr(0, 14), "speaks version");
  const Words other = obstaclesOf([](StationCard& card) { card.experiment += 1; });
  ASSERT_EQ(other.size(), 1u);
  EXPECT_EQ(other[0], fmt::format("has another experiment ({:016x}, here {:016x})", hash_ + 1, hash_));
}

TEST_F(OneStation, GapsAndClocksThatJumpStandInTheWay) {
  using Light = StationStatus::Light;
  open(1, true);
  showCard(2, false);
  LinkStatus& status = memory().status[1];
  const auto standing = [&] {
    hear(2, 0.002);
    return statusNow();
  };
  status.gap.store(0.026);
  EXPECT_EQ(standing().light, Light::Fair) << "more than half of what is allowed";
  status.gap.store(0.051);
  EXPECT_EQ(standing().light, Light::Stop);
  EXPECT_EQ(standing().obstacles, Words{"nothing comes for 51 ms at a time; allowed: up to 50"});
  status.gap.store(0);
  status.offset.store(2);
  EXPECT_EQ(standing().light, Light::Good) << "in its first second the clock is still looked for";
  for (int look = 0; look < 110; ++look) (void)standing(), std::this_thread::sleep_for(std::chrono::milliseconds(10));
  status.offset.store(2.004);
  EXPECT_EQ(standing().light, Light::Good);
  status.offset.store(2.0105);
  EXPECT_EQ(standing().obstacles, Words{"its clock jumped by 6.5 ms against this one's; allowed: up to 5"});
}

TEST_F(OneStation, HowAnEndpointEndedIsSaid) {
  const auto saysOf = [&](const std::string& script) {
    StationOptions options;
    options.station = 1;
    options.endpoint = folder_.writeProgram("ends", script);
    StationLink link(options, 1);
    for (int look = 0; look < 500 && link.endpointFault().empty(); ++look) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_FALSE(link.endpointAlive());
    EXPECT_EQ(link.obstacles().at(0), link.endpointFault());
    return link.endpointFault();
  };
  EXPECT_EQ(saysOf("exit 7"), "this station's endpoint has ended with exit code 7");
  EXPECT_EQ(saysOf("kill -TERM $$; sleep 5"), "this station's endpoint was ended by signal 15");
}

}  // namespace
}  // namespace reachlab::network
