#include "network/coupled_copy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/ticks.h"
#include "network/study/two_hands.h"

namespace reachlab::network {
namespace {

constexpr double kStart = 0;

/// A copy of the study's chain with one peer, and time.
struct Station {
  experiment::Experiment experiment = makeStudyExperiment(StudyObject::Chain);
  CoupledCopy copy{experiment, constraints::makeConstraint(experiment.constraint), 0, copySettingsFor(experiment)};
  double now = 0;
  CopySample peer;

  Station() {
    copy.placeAtRest(std::array{kStart});
    copy.fill(peer, {{}, {}, true});
  }
  dynamics::StepStatus step() {
    now += kTickSeconds;
    copy.beginTick(now);
    dynamics::HandSegment still;
    return copy.step(still, kTickSeconds);
  }
  void hear(double delay = 0.01, double roundTrip = 0.02) {
    ++peer.sequence;
    peer.time = now + kTickSeconds - delay;
    copy.beginTick(now + kTickSeconds);
    copy.take(0, peer, roundTrip);
  }
};

TEST(CoupledCopy, AnObjectAtRestStaysAtRest) {
  Station s;
  for (int i = 0; i < 500; ++i) {
    s.hear();
    ASSERT_EQ(s.step(), dynamics::StepStatus::Ok);
  }
  EXPECT_EQ(s.copy.line(0).fade, 1);
  EXPECT_NEAR(s.copy.line(0).usualAge, 0.01, 1e-9);
  EXPECT_EQ(s.copy.objectEnergy(), 0);
  EXPECT_EQ(s.copy.ledger(), 0);
}

// Of the rules: held for usual age + 50 ms, let go within another 50 ms, then lost.
TEST(CoupledCopy, ASilentPeerFadesAndIsLost) {
  Station s;
  for (int i = 0; i < 200; ++i) s.hear(), (void)s.step();
  int held = 0, fading = 0;
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  while (status == dynamics::StepStatus::Ok && held + fading < 1000) {
    status = s.step();
    if (s.copy.line(0).fade == 1) ++held;
    else if (s.copy.line(0).fade > 0) ++fading;
  }
  EXPECT_EQ(status, dynamics::StepStatus::PeerLost);
  EXPECT_NEAR(held, 50, 1);
  EXPECT_NEAR(fading, 50, 1);
  EXPECT_TRUE(s.copy.anyLost());
  s.hear();
  EXPECT_EQ(s.step(), dynamics::StepStatus::PeerLost) << "lost for the rest of the trial";
  s.copy.placeAtRest(std::array{kStart});
  s.hear();
  EXPECT_EQ(s.step(), dynamics::StepStatus::Ok) << "and back with the next";
}

TEST(CoupledCopy, AGapShorterThanTheFadeIsGoneThrough) {
  for (const int gap : {30, 90}) {
    Station s;
    for (int i = 0; i < 200; ++i) s.hear(), (void)s.step();
    for (int i = 0; i < gap; ++i) ASSERT_EQ(s.step(), dynamics::StepStatus::Ok) << gap;
    EXPECT_EQ(s.copy.line(0).fade == 1, gap == 30) << gap;
    s.hear();
    ASSERT_EQ(s.step(), dynamics::StepStatus::Ok);
    EXPECT_EQ(s.copy.line(0).fade, 1) << gap;
  }
}

TEST(CoupledCopy, APeerNeverHeardIsLostToo) {
  Station s;
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  int ticks = 0;
  for (; status == dynamics::StepStatus::Ok && ticks < 1000; ++ticks) status = s.step();
  EXPECT_EQ(status, dynamics::StepStatus::PeerLost);
  EXPECT_NEAR(ticks, 350, 2) << "a quarter of a second for the first word, as the trial is put up there too";
}

TEST(CoupledCopy, WhatIsNoNewerIsCountedAndChangesNothing) {
  Station s, other;
  for (int i = 0; i < 200; ++i) {
    for (Station* station : {&s, &other}) {
      station->peer.hand.x = 0.001 * i;
      station->hear();
    }
    CopySample replayed = s.peer;
    replayed.hand.x = 5;
    s.copy.take(0, replayed, 0.02);
    --replayed.sequence;
    s.copy.take(0, replayed, 0.02);
    (void)s.step();
    (void)other.step();
  }
  EXPECT_EQ(s.copy.line(0).old, 400u);
  EXPECT_EQ(s.copy.objectEnergy(), other.copy.objectEnergy());
  EXPECT_GT(s.copy.objectEnergy(), 0);
}

TEST(CoupledCopy, ARemoteHandIsMovedOnByItsSpeedFor60Milliseconds) {
  Station s;
  s.peer.handVelocity.x = 0.1;
  s.hear(0.02);
  (void)s.step();
  EXPECT_NEAR(s.copy.line(0).age, 0.02, 1e-12);
  // 600 N/m on mass 5, which is still at the start: 2 mm further.
  Station still;
  still.peer.hand.x = 0.1 * 0.02;
  still.hear(0.02);
  (void)still.step();
  EXPECT_NEAR(s.copy.objectEnergy() / still.copy.objectEnergy(), 1, 1e-3);
}

TEST(CoupledCopy, SynchronisationTakesTheCopyToThePeers) {
  Station s;
  for (int i = 0; i < 5; ++i) s.peer.places[static_cast<std::size_t>(i)] += 0.01;
  s.peer.hand.x = 0.01;
  double before = 0;
  for (int i = 0; i < 4000; ++i) {
    s.hear();
    ASSERT_EQ(s.step(), dynamics::StepStatus::Ok);
    if (i == 10) before = s.copy.line(0).apart;
  }
  EXPECT_NEAR(before, 0.01, 0.001);
  EXPECT_LT(s.copy.line(0).apart, 0.008) << "between its own hand, which holds it back, and the peer";
}

TEST(CoupledCopy, TheFrequencyFollowsTheRoundTripSlowly) {
  Station s;
  for (int i = 0; i < 10; ++i) s.hear(0.01, 0.02), (void)s.step();
  EXPECT_EQ(s.copy.line(0).frequency, 3) << "0.25/(0.023 s) is more";
  for (int i = 0; i < 500; ++i) s.hear(0.01, 0.6), (void)s.step();
  EXPECT_LT(s.copy.line(0).frequency, 3);
  EXPECT_GT(s.copy.line(0).frequency, 3 - 0.51) << "by 1 rad/s a second at most";
  s.copy.freeze(true);
  const double frozen = s.copy.line(0).frequency;
  for (int i = 0; i < 100; ++i) s.hear(0.01, 0.6), (void)s.step();
  EXPECT_EQ(s.copy.line(0).frequency, frozen);
}

TEST(CoupledCopy, RefusesOneHandAndObjectsThatNoSampleHolds) {
  experiment::Experiment one = makeStudyExperiment(StudyObject::Chain);
  one.hands.resize(1);
  const constraints::Constraint line = constraints::makeConstraint(one.constraint);
  EXPECT_THROW(CoupledCopy(one, line, 0, {}), RefusedError);
  experiment::Experiment many = makeStudyExperiment(StudyObject::Chain);
  many.object.masses.assign(65, 0.6);
  many.object.stiffness.assign(64, 600);
  many.object.damping.assign(64, 0);
  EXPECT_THROW(CoupledCopy(many, line, 0, {}), RefusedError);
  EXPECT_THROW(CoupledCopy(makeStudyExperiment(StudyObject::Chain), line, 2, {}), RefusedError);
}

}  // namespace
}  // namespace reachlab::network
