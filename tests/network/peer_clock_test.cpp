#include "network/endpoint/peer_clock.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace reachlab::network
