#include "network/station/observer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "sim/experiment/experiment.h"
#include "tests/record/made_run.h"

// An observer, with the test in the endpoint's place.
namespace reachlab::network {
namespace {

class ObserverOfStations : public testing::Test {
 protected:
  void SetUp() override {
    StationSetup setup;
    setup.link.endpoint = folder_.writeProgram("endpoint", "exec sleep 60");
    setup.wait = 0.1;
    observer_ = std::make_unique<Observer>(setup, experiment_);
  }
  void TearDown() override { (void)observer_->link().finish(); }
  LinkMemory& memory() { return observer_->link().memory(); }
  void hear(std::size_t station, double place, double hand) {
    HeardState heard;
    heard.trial = 3;
    heard.phase = static_cast<std::uint8_t>(trial::Phase::Moving);
    heard.sample.sequence = ++sequence_;
    heard.sample.time = 0.1;
    heard.sample.hand = {hand, 0, 0};
    for (std::size_t i = 0; i < 5; ++i) heard.sample.places[i] = place;
    ASSERT_TRUE(memory().in[station - 1].tryPush(heard));
  }
  const TemporaryFolder folder_;
  const experiment::CompiledExperiment experiment_{experiment::readExperiment("chain-two-hands")};
  std::unique_ptr<Observer> observer_;
  std::uint32_t sequence_ = 0;
};

TEST_F(ObserverOfStations, SeesTheConductorsCopyAndEveryHand) {
  EXPECT_EQ(observer_->state(), nullptr);
  hear(1, 0, -0.09);
  (void)observer_->poll();
  ASSERT_NE(observer_->state(), nullptr);
  EXPECT_NEAR(observer_->state()->masses[4].r.x, -0.1, 1e-9) << "the first that is heard, until one conducts";
  StationCard card;
  card.station = 2, card.conductor = true;
  ASSERT_TRUE(memory().cardsIn.tryPush(card));
  hear(2, M_PI, 0.02);
  const std::uint64_t before = observer_->state()->tick;
  (void)observer_->poll();
  const haptics::TickState& state = *observer_->state();
  EXPECT_GT(state.tick, before) << "what is shown is known to be new";
  EXPECT_EQ(state.trial, 3);
  EXPECT_EQ(state.phase, trial::Phase::Moving);
  EXPECT_EQ(state.massCount, 5);
  EXPECT_NEAR(state.masses[0].r.x, 0, 1e-9);
  EXPECT_EQ(state.hands[0].hip.position.x, -0.09);
  EXPECT_FALSE(observer_->hands().known[0]);
  EXPECT_TRUE(observer_->hands().known[1]);
  EXPECT_EQ(observer_->hands().place[1].x, 0.02);
  EXPECT_NEAR(observer_->apart(1), 0.1, 1e-9);
}

TEST_F(ObserverOfStations, ThatHearsAStationDoesNotSayThatNobodyIsThere) {
  hear(1, 0, -0.09);
  ::usleep(150'000);  // longer than it waits
  EXPECT_EQ(observer_->poll().problem, "");
}

TEST_F(ObserverOfStations, PutsOfEveryStationThatWasHeardALineIntoWords) {
  EXPECT_EQ(describeNewest(*observer_, 0), "");
  hear(1, 0, -0.09);
  (void)observer_->poll();
  const std::string first = "station=1 trial=3 phase=moving age_s=0.150 hand_m=-0.09000,0.00000,0.00000 work_j=0.00000\n";
  EXPECT_EQ(describeNewest(*observer_, 0.25), first);
  hear(2, M_PI, 0.02);
  (void)observer_->poll();
  EXPECT_EQ(describeNewest(*observer_, 0.25),
            first + "station=2 trial=3 phase=moving age_s=0.150 hand_m=0.02000,0.00000,0.00000 work_j=0.00000 apart_m=0.100000\n");
}

TEST_F(ObserverOfStations, SendsNothingAndSaysOnceThatNobodyIsThere) {
  std::string problem;
  int told = 0;
  for (int i = 0; i < 50; ++i) {
    if (const ObserverNews news = observer_->poll(); !news.problem.empty()) problem = news.problem, ++told;
    ::usleep(5000);
  }
  EXPECT_EQ(problem, "no station was heard within 0 s");
  EXPECT_EQ(told, 1);
  OwnState state;
  LinkEvent event;
  EXPECT_FALSE(memory().out.tryPop(state));
  EXPECT_FALSE(memory().eventsOut.tryPop(event));
}

TEST_F(ObserverOfStations, HearsHowTrialsEnd) {
  LinkEvent event;
  event.station = 2, event.kind = LinkEvent::Kind::Ended, event.trial = 4, event.outcome = trial::Outcome::Success, event.apart = 2e-4;
  ASSERT_TRUE(memory().eventsIn.tryPush(event));
  event.kind = LinkEvent::Kind::Finish;
  ASSERT_TRUE(memory().eventsIn.tryPush(event));
  const ObserverNews news = observer_->poll();
  ASSERT_EQ(news.ended.size(), 1u);
  EXPECT_EQ(wordsOf(news.ended[0]), "station 2: trial 4 success, copies apart 0.200 mm RMS");
  EXPECT_TRUE(news.finished);
}

}  // namespace
}  // namespace reachlab::network
