#include "sim/haptics/timing_check.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

namespace reachlab::haptics {
namespace {

trial::ProtocolSettings limits() {
  trial::ProtocolSettings s;
  s.maxMissedTicks = 5;
  s.maxGapTicks = 20;
  return s;
}

LoopReport watched(std::uint64_t missed, double longestGapMs) {
  return {.ticks = 2000 - missed,
          .seconds = 2,
          .latenessMax = 90,
          .faults = {.missedTicks = missed, .longestGapNs = static_cast<std::uint64_t>(longestGapMs * 1e6)},
          .mode = "SCHED_FIFO 80, memory locked",
          .realTime = true};
}

TEST(TimingCheck, IsGoodAsLongAsAMovementThatMissedAsMuchWouldCount) {
  EXPECT_EQ(judgeTiming(watched(0, 0), limits()).sentence, "timing good: in 2.00 s 0 of 2000 ticks missed, longest gap 1.09 ms");
  EXPECT_TRUE(judgeTiming(watched(5, 6.2), limits()).good);
  EXPECT_FALSE(judgeTiming(watched(6, 2.1), limits()).good) << "six single ticks";
  trial::ProtocolSettings many = limits();
  many.maxMissedTicks = 100;
  EXPECT_TRUE(judgeTiming(watched(19, 20.9), many).good) << "whole ticks, as in a movement";
  EXPECT_FALSE(judgeTiming(watched(20, 21), many).good);
}

TEST(TimingCheck, TheLongestGapIsTheCountedOneOrTheLatestTicks) {
  LoopReport report = watched(2, 4.5);
  report.latenessMax = 3600;
  EXPECT_TRUE(holds(judgeTiming(report, limits()).sentence, "2 of 2000 ticks missed, longest gap 4.60 ms"));
  report.latenessMax = 3400;
  EXPECT_TRUE(holds(judgeTiming(report, limits()).sentence, "longest gap 4.50 ms"));
  EXPECT_TRUE(judgeTiming(report, limits()).realTime);
  report.realTime = false;
  EXPECT_FALSE(judgeTiming(report, limits()).realTime);
}

TEST(TimingCheck, ALoopThatNeverTickedIsNotGood) { EXPECT_FALSE(judgeTiming(LoopReport{}, limits()).good); }

TEST(TimingCheck, SaysWhatAMovementMayMissAndHowToGetPriority) {
  LoopReport report = watched(41, 12.31);
  report.realTime = false;
  report.mode = "no real-time priority (Operation not permitted), memory locked";
  EXPECT_EQ(
      judgeTiming(report, limits()).sentence,
      "timing not good enough: in 2.00 s 41 of 2000 ticks missed, longest gap 12.31 ms; a movement that misses more than 5 ticks, or has a "
      "gap above 20 ms, does not count: end other programs; no real-time priority (Operation not permitted), memory locked: the page "
      "Timing (docs/timing.md) says how to get it");
  report = watched(0, 0);
  report.realTime = false;
  report.mode = "no real-time priority (Operation not permitted), memory locked";
  EXPECT_TRUE(holds(judgeTiming(report, limits()).sentence, "timing good"));
  EXPECT_TRUE(holds(judgeTiming(report, limits()).sentence, "says how to get it")) << "told though it went well for two seconds";
}

}  // namespace
}  // namespace reachlab::haptics
