#include "network/endpoint/peer_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/math/seeded.h"
#include "network/endpoint/message_limit.h"
#include "network/endpoint/probe_loss.h"

namespace reachlab::network {
namespace {

constexpr std::int64_t kTick = 1'000'000, kAhead = 5'000'000'000;  // [ns]; the peer's clock is 5 s ahead

/// A sample of a peer that comes `way` after it left. The peer heard ours `way` after it left, a millisecond before its own.
void send(PeerClock& clock, std::int64_t way, std::uint32_t number, bool answers = true) {
  const std::int64_t left = number * kTick;
  Echo echo{number, left + kAhead, 0, 0};
  if (answers) echo.oursLeft = left - kTick - way, echo.oursCame = left - kTick + kAhead;
  clock.add(echo, left + way);
}

TEST(PeerClock, KnowsRoundTripAndClockOnceAnEchoHasCome) {
  PeerClock clock;
  send(clock, 20 * kTick, 1000, false);
  EXPECT_LT(clock.roundTrip, 0);
  send(clock, 20 * kTick, 1001);
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

TEST(PeerClock, SamplesOfEveryFourthTickAreNoLoss) {
  PeerClock clock;
  for (std::uint32_t i = 4; i <= 2400; i += 4) send(clock, 20 * kTick, i);
  EXPECT_EQ(clock.missing, 0);
  EXPECT_NEAR(clock.gap, 0.004, 1e-9);
}

// Each second by itself: how many of its numbers came.
TEST(PeerClock, CountsEverySecondByItself) {
  PeerClock clock;
  const auto second = [&](std::uint32_t from, std::uint32_t to, std::uint32_t lostFrom, std::uint32_t lostTo) {
    for (std::uint32_t i = from; i <= to; ++i)
      if (i < lostFrom || i >= lostTo) send(clock, 20 * kTick, i);
  };
  second(1, 1000, 500, 600);
  EXPECT_EQ(clock.missing, 0) << "not before the second is over";
  EXPECT_EQ(clock.gap, 0);
  send(clock, 20 * kTick, 1001);
  EXPECT_NEAR(clock.missing, 100.0 / 1001, 1e-12);
  EXPECT_NEAR(clock.gap, 0.101, 1e-12);
  second(1002, 2001, 0, 0);
  EXPECT_EQ(clock.missing, 0);
  EXPECT_NEAR(clock.gap, 0.001, 1e-12);
  second(2002, 3001, 2100, 2350);
  EXPECT_NEAR(clock.missing, 0.25, 1e-12);
  EXPECT_EQ(clock.echoHeard, 3021 * kTick);
  EXPECT_EQ(clock.echoSent, 3001 * kTick + kAhead);
}

TEST(PeerClock, OfAPeerThatBeginsAnewCountsFromItsNewNumber) {
  PeerClock clock;
  for (std::uint32_t i = 5000; i <= 5400; ++i) send(clock, 20 * kTick, i);
  for (std::uint32_t i = 1; i <= 1001; ++i) clock.add({i, 0, 0, 0}, (5500 + i) * kTick);  // its program was started again
  EXPECT_EQ(clock.missing, 0);
  EXPECT_NEAR(clock.gap, 0.081, 1e-12);
  EXPECT_NEAR(clock.roundTrip, 0.04, 1e-12) << "it has heard nothing of ours since";
}

// Of the last 128 exchanges.
TEST(PeerClock, ForgetsAnExchangeAfter127Others) {
  PeerClock clock;
  const auto exchange = [&](std::uint32_t number, std::int64_t there, std::int64_t back) {
    const std::int64_t left = number * kTick;
    clock.add({number, left + kAhead, left - kTick - there, left - kTick + kAhead}, left + back);
  };
  exchange(1000, 2 * kTick, 2 * kTick);
  for (std::uint32_t i = 1; i <= 127; ++i) exchange(1000 + i, 4 * kTick, 12 * kTick);
  EXPECT_NEAR(clock.offset, 5, 1e-12) << "of the one whose ways were the same";
  EXPECT_NEAR(clock.jitter, 0.012 * std::sqrt(127.0) / 128, 1e-9) << "one of 4 ms among 127 of 16 ms";
  exchange(1128, 4 * kTick, 12 * kTick);
  EXPECT_NEAR(clock.offset, 5 - 0.004, 1e-12) << "half of what the way here is longer";
  EXPECT_NEAR(clock.jitter, 0, 1e-8);
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

double lossOver(std::uint32_t from, std::uint32_t to, const std::function<bool(std::uint32_t)>& comes, ProbeLoss loss = {}) {
  for (std::uint32_t number = from; number <= to; ++number)
    if (comes(number)) loss.add(number);
  return loss.share();
}

TEST(ProbeLoss, IsTheShareOfTheLastHundredOrFiveHundredThatDidNotCome) {
  const auto all = [](std::uint32_t) { return true; };
  EXPECT_EQ(lossOver(7, 1000, all), 0);
  EXPECT_NEAR(lossOver(1, 1001, [](std::uint32_t number) { return number % 5 != 0; }), 0.2, 1e-12);
  EXPECT_NEAR(lossOver(1, 1000, [](std::uint32_t number) { return number > 970 || number <= 940; }), 0.3, 1e-12) << "at one go";
  EXPECT_EQ(lossOver(1, 1000, [](std::uint32_t number) { return number > 900; }), 0) << "nothing is known of before the first";
  EXPECT_NEAR(lossOver(1, 1000, [](std::uint32_t number) { return number < 10 || number == 1000; }), 0.998, 1e-12);
  EXPECT_NEAR(lossOver(1, 1000, [](std::uint32_t number) { return number > 900 || number % 2 == 0; }), 0.4, 1e-12) << "a hundred good ones";
  EXPECT_EQ(lossOver(1, 1000, [](std::uint32_t number) { return number > 500 || number % 2 == 0; }), 0) << "forgotten after five hundred";
}

/// How many of a thousand links that lose `lost` have a bound of at most a fifth at any moment of the first `seconds`, 50 probes each.
int linksThought(double lost, int seconds) {
  int good = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    ProbeLoss loss;
    bool once = false;
    for (std::uint32_t number = 1; number <= static_cast<std::uint32_t>(50 * seconds) && !once; ++number) {
      if (seededFraction(seed, number) < lost) continue;
      loss.add(number);
      once = loss.bound() <= 0.2;
    }
    good += once ? 1 : 0;
  }
  return good;
}

// The first few probes, or two lucky seconds, must not let a bad link through.
TEST(ProbeLoss, OfALinkThatLosesMoreThanAFifthIsHardlyEverBoundedByAFifth) {
  EXPECT_LE(linksThought(0.2, 60), 10);
  EXPECT_EQ(linksThought(0.25, 60), 0);
  EXPECT_EQ(linksThought(0.5, 10), 0);
  EXPECT_EQ(linksThought(0.05, 10), 1000);
  EXPECT_EQ(linksThought(0.1, 60), 1000);
}

// n + z^2 probes of which none is lost bound the loss by z^2 / (n + z^2) (Wilson).
TEST(ProbeLoss, IsBoundedOnlyByWhatHasCome) {
  EXPECT_EQ(ProbeLoss().bound(), 1);
  const auto all = [](std::uint32_t) { return true; };
  ProbeLoss loss;
  for (std::uint32_t number = 1; number <= 56; ++number) {
    loss.add(number);
    EXPECT_NEAR(loss.bound(), 3.719 * 3.719 / (number + 3.719 * 3.719), 1e-12);
  }
  EXPECT_LE(loss.bound(), 0.2);
  EXPECT_EQ(lossOver(57, 58, all, loss), 0);
}

TEST(ProbeLoss, IsNotJudgedByThoseOfAnEarlierStart) {
  ProbeLoss before;
  for (std::uint32_t number = 5000; number < 5100; number += 2) before.add(number);
  EXPECT_NEAR(before.share(), 0.5, 0.01);
  EXPECT_EQ(lossOver(
                1, 50, [](std::uint32_t) { return true; }, before),
            0)
      << "its program was started again";
}

TEST(MessageLimit, LetsTenAMinuteThroughAndCountsTheOthers) {
  MessageLimit limit;
  int printed = 0;
  for (int i = 0; i < 10'000; ++i)
    if (limit.admit(100 + 1e-3 * i)) ++printed;
  EXPECT_EQ(printed, 10);
  EXPECT_EQ(limit.admit(159), std::nullopt);
  EXPECT_EQ(limit.admit(160), 9991u) << "held back before it";
  EXPECT_EQ(limit.admit(161), 0u);
  EXPECT_EQ(limit.takeHeld(), 0u);
  for (int i = 0; i < 20; ++i) (void)limit.admit(162);
  EXPECT_EQ(limit.takeHeld(), 12u) << "what is told at the end";
}

}  // namespace
}  // namespace reachlab::network
