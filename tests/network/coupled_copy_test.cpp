#include "network/coupled_copy.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

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

// A copy that moves as a whole with 0.1 m/s, whose hands have done no work: what it holds too much is its kinetic energy T, which is taken out
// at -O/(0.05 s 2 T) = 10 a second, and at most at 20 a second. Over a tick the hands' springs do a thousandth of that.
TEST(CoupledCopy, WhatNoHandHasPutInIsTakenOut) {
  for (const auto& [peersWork, rate] : {std::pair{0.0, 10.0}, std::pair{-1.0, 20.0}, std::pair{1.0, 0.0}}) {
    Station s;
    s.copy.place(std::array{kStart}, std::array{0.1});
    s.copy.fill(s.peer, {{}, {}, true});
    s.peer.work = peersWork;
    const double before = s.copy.objectEnergy();
    ASSERT_NEAR(before, 0.5 * 5 * 0.6 * 0.1 * 0.1, 1e-12);
    s.hear();
    ASSERT_EQ(s.step(), dynamics::StepStatus::Ok);
    EXPECT_NEAR(s.copy.ledger(), peersWork - before, 1e-12);
    EXPECT_NEAR(s.copy.objectEnergy() / before, std::exp(-2 * rate * kTickSeconds), 2e-3) << rate;
  }
}

TEST(CoupledCopy, NothingIsTakenOutBeforeEveryPeerWasHeard) {
  Station s;
  s.copy.place(std::array{kStart}, std::array{0.1});
  const double before = s.copy.objectEnergy();
  ASSERT_EQ(s.step(), dynamics::StepStatus::Ok);
  EXPECT_NEAR(s.copy.objectEnergy() / before, 1, 2e-3);
  EXPECT_NEAR(s.copy.ledger(), -before, 1e-12);
}

TEST(CoupledCopy, AHandIsMovedOnNoFurtherThan60MillisecondsTakeIt) {
  Station s, still;
  s.peer.handVelocity.x = 0.1;
  still.peer.hand.x = 0.1 * 0.06;
  still.peer.handVelocity.x = 0.1;
  for (Station* station : {&s, &still}) {
    station->hear(station == &s ? 0.2 : 0);
    ASSERT_EQ(station->step(), dynamics::StepStatus::Ok);
  }
  EXPECT_NEAR(s.copy.objectEnergy() / still.copy.objectEnergy(), 1, 1e-9);
}

// The copy lies beside the peer's by 10 mm at rest: in the first tick every mass gains omega^2 10 mm dt; beside two peers, by each half of it.
TEST(CoupledCopy, SynchronisationIsAnEvenShareOfEachPeersDifference) {
  for (const std::size_t peers : {1u, 2u}) {
    experiment::Experiment experiment = makeStudyExperiment(StudyObject::Chain);
    experiment.hands.resize(2);
    if (peers == 2) experiment.hands.push_back({3, {1}, {0}, {}});
    CoupledCopy copy(experiment, constraints::makeConstraint(experiment.constraint), 0, copySettingsFor(experiment));
    copy.placeAtRest(std::array{kStart});
    CopySample sample, own;
    copy.fill(own, {{}, {}, true});
    sample = own;
    for (std::size_t i = 0; i < 5; ++i) sample.places[i] += 0.01, sample.rates[i] = 0.02;
    copy.beginTick(kTickSeconds);
    for (std::size_t peer = 0; peer < peers; ++peer) {
      CopySample& one = peer == 0 ? sample : own;
      one.sequence = 1, one.time = kTickSeconds, one.work = 1;
      copy.take(static_cast<int>(peer), one, 0.02);
    }
    ASSERT_EQ(copy.step({}, kTickSeconds), dynamics::StepStatus::Ok);
    CopySample after;
    copy.fill(after, {{}, {}, true});
    const double omega = 3;
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(after.rates[i], (omega * omega * 0.01 + 2 * omega * 0.02) * kTickSeconds / static_cast<double>(peers), 2e-6) << i;
  }
}

// What moved evenly for a while lay 2 mm further back 20 ms ago, where the peer's sample says that it was.
TEST(CoupledCopy, HowFarCopiesAreApartIsSaidOfTheSamplesTime) {
  Station s;
  s.copy.setCoupled(false);
  s.copy.place(std::array{kStart}, std::array{0.1});
  std::vector<CopySample> past(100);
  for (std::size_t i = 0; i < past.size(); ++i) {
    ASSERT_EQ(s.step(), dynamics::StepStatus::Ok);
    s.copy.fill(past[i], {{}, {}, true});
  }
  const CopySample then = past[80];
  s.peer = then;
  s.peer.sequence = 0;
  s.hear(0.02);
  ASSERT_EQ(s.step(), dynamics::StepStatus::Ok);
  EXPECT_NEAR(s.copy.line(0).apart, 0, 1e-6);
  s.peer = then;
  s.peer.sequence = 1;
  for (std::size_t i = 0; i < 5; ++i) s.peer.places[i] += 0.003;
  s.hear(0.021);
  ASSERT_EQ(s.step(), dynamics::StepStatus::Ok);
  EXPECT_NEAR(s.copy.line(0).apart, 0.003, 1e-6);
}

TEST(CoupledCopy, CountsWhatIsLostOfAPeersSamplesInAWholeSecond) {
  Station whole, lossy, everyFourth;
  for (int i = 0; i < 1200; ++i) {
    whole.hear();
    if (i % 4 != 3) lossy.hear();
    else ++lossy.peer.sequence;
    if (i == 500) EXPECT_EQ(lossy.copy.line(0).loss, -1) << "no whole second yet";
    if (i % 4 == 0) everyFourth.peer.sequence += 3, everyFourth.hear();
    for (Station* station : {&whole, &lossy, &everyFourth}) (void)station->step();
  }
  EXPECT_EQ(whole.copy.line(0).loss, 0);
  EXPECT_NEAR(lossy.copy.line(0).loss, 0.25, 0.002);
  EXPECT_EQ(everyFourth.copy.line(0).loss, 0) << "not every tick need be sent";
  EXPECT_EQ(lossy.copy.line(0).taken, 900u);
}

TEST(CoupledCopy, TheUsualAgeIsTheMedian) {
  Station s;
  for (int i = 0; i < 300; ++i) s.hear(i % 5 < 2 ? 0.04 : 0.012), (void)s.step();
  EXPECT_NEAR(s.copy.line(0).usualAge, 0.012, 1e-9) << "three of five";
}

// The first is taken as it is; from then on the mean forgets in a second.
TEST(CoupledCopy, TheRoundTripIsAMeanOverASecond) {
  Station s;
  s.hear(0.01, -1);
  EXPECT_EQ(s.copy.line(0).roundTrip, 0) << "not known";
  s.hear(0.01, 0.1);
  EXPECT_EQ(s.copy.line(0).roundTrip, 0.1);
  for (int i = 0; i < 1000; ++i) s.hear(0.01, 0.2), (void)s.step();
  EXPECT_NEAR(s.copy.line(0).roundTrip, 0.1 + 0.1 * (1 - std::exp(-1)), 1e-4);
}

TEST(CoupledCopy, TheFrequencyIsThatOfTheObjectOrAQuarterOfTheLoop) {
  const CopySettings chain = copySettingsFor(makeStudyExperiment(StudyObject::Chain));
  EXPECT_EQ(chain.frequency, 3);
  EXPECT_EQ(copySettingsFor(makeStudyExperiment(StudyObject::Parallel)).frequency, 1);
  EXPECT_NEAR(synchronisationLimit(chain, 0.197), 0.25 / 0.2, 1e-12) << "with a tick and a half at either end";
  Station s;
  s.hear(0.01, 0.197);
  s.copy.setFrequency(1);
  EXPECT_EQ(s.copy.line(0).frequency, 1);
  s.copy.setFrequency(5);
  EXPECT_NEAR(s.copy.line(0).frequency, 1.25, 1e-12);
}

TEST(CoupledCopy, WhatIsKnownOfALineOutlastsTheTrialAndNothingElseDoes) {
  Station s;
  for (int i = 0; i < 1200; ++i) {
    s.hear(0.01, 0.05);
    if (i % 2 == 0) s.copy.take(0, s.peer, 0.05);
    (void)s.step();
  }
  const PeerLine before = s.copy.line(0);
  s.copy.placeAtRest(std::array{kStart});
  const PeerLine after = s.copy.line(0);
  EXPECT_EQ(after.roundTrip, before.roundTrip);
  EXPECT_EQ(after.usualAge, before.usualAge);
  EXPECT_EQ(after.loss, before.loss);
  EXPECT_EQ(after.taken, 1200u);
  EXPECT_EQ(after.old, 600u);
  EXPECT_FALSE(after.heard);
  EXPECT_EQ(after.age, 0);
  EXPECT_EQ(s.copy.ledger(), 0);
  const std::uint64_t old = after.old;
  s.copy.take(0, s.peer, 0.05);
  EXPECT_EQ(s.copy.line(0).old, old + 1) << "a sample of the trial before";
}

}  // namespace
}  // namespace reachlab::network
