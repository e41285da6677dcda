#include "analysis/hands.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reachlab::analysis {
namespace {

constexpr double kHandsRate = 100;

/// A hand of so many samples whose speed is a bell that begins after `late` seconds.
HandSignals handWithBell(double late, double height = 0.4, std::size_t samples = 200) {
  HandSignals hand;
  for (std::size_t i = 0; i < samples; ++i) {
    const double s = (static_cast<double>(i) / kHandsRate - 0.5 - late) / 0.6;
    hand.velocity.push_back({0, s < 0 || s > 1 ? 0 : -height * 16 * s * s * (1 - s) * (1 - s), 0});
    hand.place.push_back({});
    hand.force.push_back({});
    hand.work.push_back(0);
  }
  return hand;
}

TEST(MeasureTogether, OfEachHandIsWorkedOutByHand) {
  HandSignals first, second;
  first.place = {{0, 0, 0}, {3, 4, 0}, {3, 4, 12}, {3, 4, 12}};
  first.velocity = {{0, 0, 0}, {3, 0, -4}, {1, 0, 0}, {0, 2, 0}};
  first.force = {{0, 0, 0}, {0, 6, 8}, {2, 0, 0}, {0, 0, 4}};
  first.work = {1, 3, 2.5, 4};
  second = first;
  second.force = {{0, 0, 0}, {0, -3, -4}, {0, 2, 0}, {0, 0, 4}};
  second.work = {0, -1, -0.5, -3};
  const TogetherMeasures m = measureTogether({first, second}, 10);
  ASSERT_EQ(m.hands.size(), 2u);
  EXPECT_DOUBLE_EQ(m.hands[0].peakSpeed, 5);
  EXPECT_DOUBLE_EQ(m.hands[0].path, 5 + 12);
  EXPECT_DOUBLE_EQ(m.hands[0].peakForce, 10);
  EXPECT_DOUBLE_EQ(m.hands[0].meanForce, (10 + 2 + 4) / 4.0);
  EXPECT_DOUBLE_EQ(m.hands[0].work, 4);
  EXPECT_DOUBLE_EQ(m.hands[0].positiveWork, 2 + 1.5);
  EXPECT_DOUBLE_EQ(m.hands[0].share, 3.5 / 4);
  EXPECT_DOUBLE_EQ(m.hands[1].work, -3);
  EXPECT_DOUBLE_EQ(m.hands[1].positiveWork, 0.5);
  EXPECT_DOUBLE_EQ(m.hands[1].share, 0.5 / 4);
  EXPECT_DOUBLE_EQ(m.hands[1].meanForce, (5 + 2 + 4) / 4.0);
  // Cancelled: nothing, the 5 of the weaker of two opposed, 2 less half of sqrt 8, nothing of two that pull together.
  const double third = 2 - std::sqrt(2.0);
  EXPECT_DOUBLE_EQ(m.peakInternalForce, 5);
  EXPECT_NEAR(m.internalForce, std::sqrt((25 + third * third) / 4), 1e-12);
}

TEST(MeasureTogether, TellsHowFarAHandIsBehindTheFirst) {
  for (const double late : {0.0, 0.07, -0.12, 0.033, 0.3}) {
    const TogetherMeasures m = measureTogether({handWithBell(0), handWithBell(late, 0.9)}, kHandsRate);
    EXPECT_NEAR(m.hands[0].lag, 0, 1e-12);
    EXPECT_NEAR(m.hands[0].lagCorrelation, 1, 1e-12);
    EXPECT_NEAR(m.hands[1].lag, late, 0.0015) << "the parabola lies between samples";
    EXPECT_NEAR(m.hands[1].lagCorrelation, 1, 0.005);
  }
}

TEST(MeasureTogether, LooksForALagWithinHalfASecondAlone) {
  const double lag = measureTogether({handWithBell(-0.3), handWithBell(0.4)}, kHandsRate).hands[1].lag;
  EXPECT_DOUBLE_EQ(lag, 0.5) << "the nearest that was tried to 0.7 s";
  EXPECT_DOUBLE_EQ(measureTogether({handWithBell(0.4), handWithBell(-0.3)}, kHandsRate).hands[1].lag, -0.5);
  HandSignals early = handWithBell(-0.5, 0.4, 60), later = handWithBell(-0.1, 0.4, 60);  // 0.6 s: half of it is less
  EXPECT_LE(std::abs(measureTogether({early, later}, kHandsRate).hands[1].lag), 0.3);
}

TEST(MeasureTogether, OfAStillHandOrNoWorkHasNoLagAndNoShare) {
  const TogetherMeasures m = measureTogether({handWithBell(0), handWithBell(0, 0)}, kHandsRate);
  EXPECT_TRUE(std::isnan(m.hands[1].lag));
  EXPECT_TRUE(std::isnan(m.hands[1].lagCorrelation));
  EXPECT_TRUE(std::isnan(m.hands[0].share));
  EXPECT_EQ(m.internalForce, 0);
  EXPECT_EQ(m.peakInternalForce, 0);
}

// Speeds that go against each other correlate the more the farther they are apart, and below 0 at once.
TEST(MeasureTogether, TellsTheCorrelationItself) {
  HandSignals a = handWithBell(0, 0, 5), b = a;
  const double first[] = {1, 2, 4, 3, 7}, second[] = {2, 3, 1, 5, 4};
  for (std::size_t i = 0; i < 5; ++i) a.velocity[i] = {first[i], 0, 0}, b.velocity[i] = {0, second[i], 0};
  // Of lags -2 … 2 the one of -1 is best: 2 4 3 7 against 2 3 1 5, whose products with their means taken off sum to 10.
  const TogetherMeasures m = measureTogether({a, b}, kHandsRate);
  EXPECT_NEAR(m.hands[1].lagCorrelation, 10 / std::sqrt(14 * 8.75), 1e-12);
}

TEST(MeasureTogether, OfNobodyIsNothing) {
  const TogetherMeasures none = measureTogether({}, kHandsRate);
  EXPECT_TRUE(none.hands.empty());
  EXPECT_EQ(none.internalForce, 0);
  EXPECT_EQ(handsTable(DatasetIndex{}), "") << "no table where no two hands were recorded";
}

}  // namespace
}  // namespace reachlab::analysis
