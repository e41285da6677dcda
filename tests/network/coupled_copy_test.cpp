#include "constraints/constraint.h"
#include "network/coupled_copy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/ticks.h"
#include "network/link_check/two_hands.h"
#include "sim/experiment/experiment.h"
#include "tests/refusal.h"

namespace reachlab::network {
namespace {

constexpr double kStart = 0;

/// A copy of the study's chain with one peer, and time.
struct CopyWithPeer {
  explicit CopyWithPeer(const experiment::Experiment& e = makeSharedExperiment(SharedObject::Chain))
      : CopyWithPeer(e, copySettingsFor(e)) {}
  CopyWithPeer(const experiment::Experiment& e, const CopySettings& settings)
      : copy(e, constraints::makeConstraint(e.constraint), 0, settings) {
    copy.placeAtRest(std::array{kStart});
    peer = told();
  }
  /// What it tells the others.
  CopySample told(const dynamics::HandSample& hand = {{}, {}, true}) const {
    CopySample sample;
    copy.fill(sample, hand);
    return sample;
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

  CoupledCopy copy;
  double now = 0;   // [s]
  CopySample peer;  // of the first peer, the newest
};

TEST(CoupledCopy, AnObjectAtRestStaysAtRest) {
  CopyWithPeer s;
  for (int i = 0; i < 500; ++i) {
    s.hear();
    ASSERT_EQ(s.step(), dynamics::StepStatus::Ok);
  }
  EXPECT_EQ(s.copy.link(0).fade, 1);
  EXPECT_NEAR(s.copy.link(0).usualAge, 0.01, 1e-9);
  EXPECT_EQ(s.copy.objectEnergy(), 0);
  EXPECT_EQ(s.copy.ledger(), 0);
}

TEST(CoupledCopy, APeerNeverHeardIsLostToo) {
  CopyWithPeer s;
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  int ticks = 0;
  for (; status == dynamics::StepStatus::Ok && ticks < 1000; ++ticks) status = s.step();
  EXPECT_EQ(status, dynamics::StepStatus::PeerLost);
  EXPECT_NEAR(ticks, 350, 2) << "a quarter of a second for the first word, as the trial is put up there too";
}

TEST(CoupledCopy, WhatIsNoNewerIsCountedAndChangesNothing) {
  CopyWithPeer s, other;
  for (int i = 0; i < 200; ++i) {
    for (CopyWithPeer* station : {&s, &other}) {
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
  EXPECT_EQ(s.copy.link(0).old, 400u);
  EXPECT_EQ(s.copy.objectEnergy(), other.copy.objectEnergy());
  EXPECT_GT(s.copy.objectEnergy(), 0);
}

// One tick after rest a mass in the middle, which no hand holds, has the speed that its acceleration makes in a millisecond.
TEST(CoupledCopy, IsDrawnToThePeersPlaceAndSpeedByTheDesignsLaw) {
  const auto speedAfter = [](double apart, double faster, double frequency, double roundTrip) {
    CopyWithPeer s;
    s.copy.setFrequency(frequency);
    for (std::size_t i = 0; i < 5; ++i) s.peer.places[i] += apart, s.peer.rates[i] += faster;
    s.hear(0.01, roundTrip);
    (void)s.step();
    return s.told().rates[2] / kTickSeconds;
  };
  EXPECT_NEAR(speedAfter(0.01, 0, 3, -1), 3 * 3 * 0.01, 1e-4);
  EXPECT_NEAR(speedAfter(-0.02, 0, 2, -1), 2 * 2 * -0.02, 1e-4);
  EXPECT_NEAR(speedAfter(0, 0.1, 3, -1), 2 * 3 * 0.1, 1e-3);
  EXPECT_NEAR(speedAfter(0.01, 0.1, 2, -1), 2 * 2 * 0.01 + 2 * 2 * 0.1, 1e-3);
  EXPECT_NEAR(speedAfter(0.01, 0, 3, 0.122), 2 * 2 * 0.01, 1e-4) << "0.25 over 125 ms are 2 rad/s";
}

TEST(CoupledCopy, EveryPeerHasItsShareOfTheSynchronisation) {
  experiment::Experiment three = makeSharedExperiment(SharedObject::Chain);
  three.hands.push_back({1, {600}, {0}, {}});
  const auto speedAfter = [&](const std::vector<double>& apart) {
    CopyWithPeer s(three);
    EXPECT_EQ(s.copy.peerCount(), 2);
    s.copy.beginTick(kTickSeconds);
    for (std::size_t k = 0; k < apart.size(); ++k) {
      CopySample sample = s.peer;
      sample.sequence = 1;
      for (std::size_t i = 0; i < 5; ++i) sample.places[i] += apart[k];
      s.copy.take(static_cast<int>(k), sample, -1);
    }
    (void)s.step();
    return s.told().rates[2] / kTickSeconds;
  };
  EXPECT_NEAR(speedAfter({0.01, 0.01}), 9 * 0.01, 1e-4);
  EXPECT_NEAR(speedAfter({0.01, -0.01}), 0, 1e-6);
  EXPECT_NEAR(speedAfter({0.01, 0.03}), 9 * 0.02, 1e-4) << "to their mean";
  EXPECT_NEAR(speedAfter({0.01}), 9 * 0.01 / 2, 1e-4) << "who was not heard yet draws nothing";
}

// The copy moves as the peer does, so that nothing but the ledger acts on its middle: 3 kg at 1 m/s are 1.5 J.
TEST(CoupledCopy, WhatNoHandHasPutInIsTakenOut) {
  const experiment::Experiment chain = makeSharedExperiment(SharedObject::Chain);
  const auto after = [&](double peersWork, const CopySettings& settings, bool heard = true) {
    CopyWithPeer s(chain, settings);
    s.copy.place(std::array{kStart}, std::array{1.0});
    s.peer = s.told();
    s.peer.work = peersWork;
    if (heard) s.hear(kTickSeconds, -1);
    (void)s.step();
    return std::pair{s.copy.ledger(), 1 - s.told().rates[2]};
  };
  const CopySettings usual = copySettingsFor(chain);
  EXPECT_NEAR(after(2, usual).first, 0.5, 1e-9);
  EXPECT_NEAR(after(2, usual).second, 0, 1e-5) << "what they have put in it may have";
  EXPECT_NEAR(after(1.2, usual).first, -0.3, 1e-9);
  EXPECT_NEAR(after(1.2, usual).second, 1e-3 * 0.3 / (0.05 * 3), 2e-5) << "in 50 ms";
  EXPECT_NEAR(after(-4, usual).second, 1e-3 * 20, 3e-4) << "with 20/s at most";
  EXPECT_NEAR(after(-4, usual, false).second, 0, 1e-5) << "not before everybody was heard";
  CopySettings without = usual;
  without.ledger = false;
  EXPECT_NEAR(after(-4, without).second, 0, 1e-5);
}

TEST(CoupledCopy, AFadeFollowsTheSilenceBeyondTheUsualAge) {
  CopyWithPeer s;
  for (int i = 0; i < 200; ++i) s.hear(0.012), (void)s.step();
  for (int i = 0; i < 130; ++i) {
    (void)s.step();
    const PeerLink& link = s.copy.link(0);
    EXPECT_NEAR(link.age, 0.012 + 1e-3 * (i + 1), 1e-9);
    if (!link.lost) {
      EXPECT_NEAR(link.fade, std::clamp(1 - (link.age - 0.012 - 0.05) / 0.05, 0.0, 1.0), 1e-9);
    }
    EXPECT_EQ(link.lost, i >= 99) << i;
  }
  s.hear();
  EXPECT_EQ(s.step(), dynamics::StepStatus::PeerLost) << "lost for the rest of the trial";
  s.copy.placeAtRest(std::array{kStart});
  s.hear();
  EXPECT_EQ(s.step(), dynamics::StepStatus::Ok) << "and back with the next";
}

TEST(CoupledCopy, TheUsualAgeIsTheMedianOfThoseLately) {
  CopyWithPeer s;
  const auto hear = [&](int times, double age) {
    for (int i = 0; i < times; ++i) s.hear(age), (void)s.step();
  };
  hear(1, 0.01);
  EXPECT_NEAR(s.copy.link(0).usualAge, 0.01, 1e-9) << "at once";
  hear(6, 0.03);
  EXPECT_NEAR(s.copy.link(0).usualAge, 0.01, 1e-9);
  hear(1, 0.03);
  EXPECT_NEAR(s.copy.link(0).usualAge, 0.03, 1e-9) << "looked at again with every eighth";
  hear(200, 0.02);
  EXPECT_NEAR(s.copy.link(0).usualAge, 0.02, 1e-9);
  for (int i = 0; i < 128; ++i) hear(1, i % 3 == 0 ? 0.045 : 0.025);
  EXPECT_NEAR(s.copy.link(0).usualAge, 0.025, 1e-9) << "a third that is late is not usual";
}

TEST(CoupledCopy, LossIsTheShareOfASecondsSamplesThatDidNotCome) {
  CopyWithPeer s;
  s.peer.sequence = 1000;
  EXPECT_EQ(s.copy.link(0).loss, -1) << "not known yet";
  const auto run = [&](int ticks, int lostOf) {  // every fourth tick one is sent
    for (int i = 0; i < ticks; ++i) {
      const bool lost = lostOf > 0 && i / 4 % lostOf == 1;
      if (i % 4 == 0) {
        if (lost) s.peer.sequence += 4;
        else s.peer.sequence += 3, s.hear();
      }
      (void)s.step();
    }
  };
  run(1004, 10);
  EXPECT_NEAR(s.copy.link(0).loss, 25.0 / 250, 1e-12);
  run(1008, 0);
  EXPECT_NEAR(s.copy.link(0).loss, 0, 1e-12);
}

TEST(CoupledCopy, TheRoundTripIsFilteredOverASecond) {
  CopyWithPeer s;
  s.hear(0.01, -1);
  EXPECT_EQ(s.copy.link(0).roundTrip, 0) << "not known";
  s.hear(0.01, 0.02);
  EXPECT_EQ(s.copy.link(0).roundTrip, 0.02);
  s.hear(0.01, 0.12);
  EXPECT_NEAR(s.copy.link(0).roundTrip, 0.0201, 1e-12);
  s.hear(0.01, -1);
  EXPECT_NEAR(s.copy.link(0).roundTrip, 0.0201, 1e-12);
}

TEST(CoupledCopy, TheNextTrialKnowsTheLineAndNothingOfTheLastOne) {
  CopyWithPeer s;
  for (int i = 0; i < 1200; ++i) {
    s.peer.places[0] = 0.001;
    s.hear();
    if (i % 3 == 0) --s.peer.sequence, s.hear(), s.copy.take(0, s.peer, -1);
    (void)s.step();
  }
  const PeerLink before = s.copy.link(0);
  ASSERT_GT(before.apart, 0);
  ASSERT_GT(before.old, 0u);
  s.copy.placeAtRest(std::array{kStart});
  const PeerLink& link = s.copy.link(0);
  EXPECT_EQ(link.roundTrip, before.roundTrip);
  EXPECT_EQ(link.usualAge, before.usualAge);
  EXPECT_EQ(link.taken, before.taken);
  EXPECT_EQ(link.old, before.old);
  EXPECT_EQ(link.loss, before.loss);
  EXPECT_FALSE(link.heard || link.lost);
  EXPECT_EQ(link.apart, 0);
  EXPECT_EQ(link.frequency, 3);
  EXPECT_EQ(s.copy.ledger(), 0);
  s.peer.sequence = 1;
  s.copy.take(0, s.peer, -1);
  EXPECT_TRUE(s.copy.link(0).heard) << "a station that was started again counts from 1";
}

// What it is told of itself, as late as the link makes it, is no distance.
TEST(CoupledCopy, IsComparedWithWhatItWasWhenTheSampleWasTaken) {
  CopyWithPeer s;
  s.copy.place(std::array{kStart}, std::array{0.5});
  std::vector<CopySample> past;
  for (int i = 0; i < 300; ++i) {
    if (i >= 20) {
      const CopySample& then = past[static_cast<std::size_t>(i - 20)];
      s.peer.places = then.places;
      s.peer.rates = then.rates;
      s.peer.work = 10;
      ++s.peer.sequence;
      s.peer.time = s.now - 19e-3;
      s.copy.beginTick(s.now + kTickSeconds);
      s.copy.take(0, s.peer, -1);
    }
    (void)s.step();
    if (i >= 20) {
      EXPECT_NEAR(s.copy.link(0).apart, 0, 1e-12) << i;
    }
    past.push_back(s.told());
  }
  EXPECT_GT(std::abs(past[10].places[2] - past[5].places[2]), 1e-3) << "it moves";
}

TEST(CoupledCopy, ASampleIsItsOwnHandWorkAndCoordinates) {
  CopyWithPeer s;
  for (int i = 0; i < 5; ++i) s.hear();
  dynamics::HandSegment hand;
  hand.position[0] = {0.01, 0, 0};
  for (int i = 0; i < 50; ++i) {
    s.now += kTickSeconds;
    s.copy.beginTick(s.now);
    (void)s.copy.step(hand, kTickSeconds);
  }
  const CopySample sample = s.told({{1, 2, 3}, {4, 5, 6}, true});
  EXPECT_EQ(sample.hand, (Vec3{1, 2, 3}));
  EXPECT_EQ(sample.handVelocity, (Vec3{4, 5, 6}));
  EXPECT_EQ(sample.work, s.copy.ownWork());
  EXPECT_NE(sample.work, 0);
  EXPECT_EQ(s.copy.placeCount(), 5);
  EXPECT_EQ(s.copy.rateCount(), 5);
  std::array<dynamics::MassState, 5> masses{};
  s.copy.observe({{0.01, 0, 0}, {}, true}, masses);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(sample.places[i], masses[i].r.x, 1e-12) << "on this line the coordinate is x";
    EXPECT_NEAR(sample.rates[i], masses[i].v.x, 1e-12);
  }
  EXPECT_NEAR(s.copy.ownFixedPoint().x, masses[0].r.x, 1e-12);
}

TEST(CoupledCopy, SaysWhyItCannotBe) {
  const auto told = [](const experiment::Experiment& e, int own) {
    return refusalOf([&] { const CoupledCopy copy(e, constraints::makeConstraint(e.constraint), own, {}); }, "made");
  };
  experiment::Experiment e = makeSharedExperiment(SharedObject::Chain);
  for (const int own : {0, 1}) EXPECT_EQ(told(e, own), "made");
  for (const int own : {-1, 2})
    EXPECT_EQ(told(e, own), "this station has hand " + std::to_string(own + 1) + " of an experiment of 2 hands");
  const auto withMasses = [&](std::size_t count) {
    e.object.masses.assign(count, 0.6);
    e.object.stiffness.assign(count - 1, 600);
    e.object.damping.assign(count - 1, 0);
    return told(e, 0);
  };
  EXPECT_EQ(withMasses(64), "made");
  EXPECT_EQ(withMasses(65), "an object that stations share has up to 64 coordinates, and this one has 65");
  e = makeSharedExperiment(SharedObject::Chain);
  e.hands.pop_back();
  EXPECT_EQ(told(e, 0), "stations move one object together: the experiment needs hands, one for each station");
}

TEST(CoupledCopy, AHandIsMovedOnByItsSpeedForUpTo60Milliseconds) {
  for (const auto& [age, moved] : {std::pair{0.02, 0.02}, {0.2, 0.06}}) {
    CopyWithPeer s, still;
    s.peer.handVelocity.x = 0.1;
    still.peer.hand.x = 0.1 * moved;
    still.peer.handVelocity.x = 0.1;
    for (CopyWithPeer* station : {&s, &still}) {
      station->hear(station == &s ? age : 0);
      ASSERT_EQ(station->step(), dynamics::StepStatus::Ok);
    }
    EXPECT_NEAR(s.copy.objectEnergy() / still.copy.objectEnergy(), 1, 1e-9) << age;
  }
}

TEST(CoupledCopy, TheFrequencyIsThatOfTheObjectOrAQuarterOfTheLoop) {
  const CopySettings chain = copySettingsFor(makeSharedExperiment(SharedObject::Chain));
  EXPECT_EQ(chain.frequency, 3);
  EXPECT_EQ(copySettingsFor(makeSharedExperiment(SharedObject::Parallel)).frequency, 1);
  EXPECT_NEAR(synchronisationLimit(chain, 0.197), 0.25 / 0.2, 1e-12) << "with a tick and a half at either end";
  CopyWithPeer s;
  s.hear(0.01, 0.197);
  s.copy.setFrequency(1);
  EXPECT_EQ(s.copy.link(0).frequency, 1);
  s.copy.setFrequency(5);
  EXPECT_NEAR(s.copy.link(0).frequency, 1.25, 1e-12);
}

}  // namespace
}  // namespace reachlab::network
