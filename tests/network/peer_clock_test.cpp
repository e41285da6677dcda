#include "network/endpoint/peer_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reachlab::network {
namespace {

constexpr std::int64_t kTick = 1'000'000, kAhead = 5'000'000'000;  // [ns]; the peer's clock is 5 s ahead

/// A peer whose samples come `way` after they left and which heard ours `way` after they left, a millisecond before its own.
class Peer {
 public:
  void send(PeerClock& clock, std::int64_t way, std::uint32_t number, bool answers = true) {
    const std::int64_t left = number * kTick, came = left + way;
    Echo echo{number, left + kAhead, 0, 0};
    if (answers) echo.oursLeft = left - kTick - way, echo.oursCame = left - kTick + kAhead;
    clock.add(echo, came);
  }
};

TEST(PeerClock, KnowsRoundTripAndClockOnceAnEchoHasCome) {
  PeerClock clock;
  Peer().send(clock, 20 * kTick, 1000, false);
  EXPECT_LT(clock.roundTrip, 0);
  Peer().send(clock, 20 * kTick, 1001);
  EXPECT_NEAR(clock.roundTrip, 0.04, 1e-9);
  EXPECT_NEAR(clock.offset, 5, 1e-9);
  EXPECT_EQ(clock.jitter, 0);
}

// Of the others the way here was longer than the way there by as much as they are slower, which shifts what they say of the clock by half.
TEST(PeerClock, TakesTheClockFromTheFastestExchange) {
  PeerClock clock;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const std::int64_t left = (1000 + i) * kTick, slower = i == 17 ? 0 : (i % 2 == 0 ? 2 : 6) * kTick;
    clock.add({1000 + i, left + kAhead, left - 21 * kTick, left - kTick + kAhead}, left + 20 * kTick + slower);
  }
  EXPECT_NEAR(clock.offset, 5, 1e-9);
  EXPECT_NEAR(clock.roundTrip, 0.046, 1e-9) << "of the newest";
  EXPECT_NEAR(clock.jitter, 0.002, 2e-4);
}

TEST(PeerClock, CountsWhatWasLostInASecondAndItsLongestGap) {
  PeerClock clock;
  for (std::uint32_t i = 1; i <= 2100; ++i)
    if (i % 4 != 0 && (i < 1500 || i > 1529)) Peer().send(clock, 20 * kTick, i);
  EXPECT_NEAR(clock.loss, 0.25 + 0.75 * 0.03, 0.005);
  EXPECT_NEAR(clock.gap, 0.031, 0.0011);
}

TEST(PeerClock, SamplesOfEveryFourthTickAreNoLoss) {
  PeerClock clock;
  for (std::uint32_t i = 4; i <= 2400; i += 4) Peer().send(clock, 20 * kTick, i);
  EXPECT_EQ(clock.loss, 0);
  EXPECT_NEAR(clock.gap, 0.004, 1e-9);
}

// RFC 5905: round trip (t4 - t1) - (t3 - t2), offset half of (t2 - t1) + (t3 - t4); here 30 ms there, 50 ms back, and 7 ms on the peer's desk.
TEST(PeerClock, TakesThePeersOwnTimeOffTheRoundTripAndHalvesWhatTheWaysDiffer) {
  PeerClock clock;
  const std::int64_t left = 2000 * kTick, came = left + 30 * kTick + kAhead, answered = came + 7 * kTick,
                     back = answered - kAhead + 50 * kTick;
  clock.add({1, answered, left, came}, back);
  EXPECT_NEAR(clock.roundTrip, 0.08, 1e-9);
  EXPECT_NEAR(clock.offset, 5 + (0.03 - 0.05) / 2, 1e-9);
  EXPECT_EQ(clock.echoSent, answered);
  EXPECT_EQ(clock.echoHeard, back);
}

// Clocks drift: an exchange counts as long as it is among the latest 128.
TEST(PeerClock, ForgetsAnExchangeAfter128Others) {
  PeerClock clock;
  const auto exchange = [&](std::uint32_t number, std::int64_t way, std::int64_t ahead) {
    const std::int64_t left = number * kTick;
    clock.add({number, left + ahead, left - kTick - way, left - kTick + ahead}, left + way);
  };
  exchange(1000, 5 * kTick, kAhead + 3 * kTick);
  for (std::uint32_t i = 1; i <= 127; ++i) exchange(1000 + i, 20 * kTick, kAhead);
  EXPECT_NEAR(clock.offset, 5.003, 1e-9);
  EXPECT_NEAR(clock.jitter, 0.03 * std::sqrt(127.0) / 128, 1e-9) << "one of 128 is 30 ms faster";
  exchange(1128, 20 * kTick, kAhead);
  EXPECT_NEAR(clock.offset, 5, 1e-9);
  EXPECT_NEAR(clock.jitter, 0, 1e-7);
}

// 1001 samples make a second, of which three are missing: of the next second nothing is, nor of a peer that begins to count anew.
TEST(PeerClock, SaysOfEachSecondWhatWasLostInIt) {
  PeerClock clock;
  const auto send = [&](std::uint32_t number, std::int64_t at) { clock.add({number, number * kTick, 0, 0}, at * kTick); };
  for (std::uint32_t i = 1; i <= 1000; ++i)
    if (i < 400 || i > 402) send(i, i);
  EXPECT_EQ(clock.loss, 0) << "no whole second yet";
  EXPECT_EQ(clock.gap, 0);
  send(1001, 1001);
  EXPECT_NEAR(clock.loss, 3 / 1001.0, 1e-12);
  EXPECT_NEAR(clock.gap, 0.004, 1e-12);
  for (std::uint32_t i = 1002; i <= 2001; ++i) send(i, i);
  EXPECT_EQ(clock.loss, 0);
  EXPECT_NEAR(clock.gap, 0.001, 1e-12);
  for (std::uint32_t i = 1; i <= 1001; ++i) send(i, 2001 + i);
  EXPECT_EQ(clock.loss, 0) << "it was started again";
}

}  // namespace
}  // namespace reachlab::network
