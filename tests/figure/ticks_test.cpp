#include "analysis/figure/ticks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reachlab::figure {
namespace {

using Major = std::vector<std::pair<double, std::string>>;

void expectTicks(const AxisTicks& ticks, double from, double to, const Major& major) {
  EXPECT_NEAR(ticks.from, from, 1e-12 * std::abs(to));
  EXPECT_NEAR(ticks.to, to, 1e-12 * std::abs(to));
  ASSERT_EQ(ticks.major.size(), major.size());
  for (std::size_t i = 0; i < major.size(); ++i) {
    EXPECT_NEAR(ticks.major[i].first, major[i].first, 1e-9 * std::abs(to)) << i;
    EXPECT_EQ(ticks.major[i].second, major[i].second);
  }
}
Axis logarithmic() {
  Axis axis;
  axis.scale = Scale::Log;
  return axis;
}

// 150 pt have room for six parts: 0.274 / 6 is rounded up to 0.05, and the ends to a quarter of that.
TEST(ChooseTicks, OnALinearAxisAreWorkedOutByHand) {
  expectTicks(chooseTicks(Axis{}, 0.013, 0.287, 150), 0.0125, 0.2875,
              {{0.05, "0.05"}, {0.1, "0.10"}, {0.15, "0.15"}, {0.2, "0.20"}, {0.25, "0.25"}});
  expectTicks(chooseTicks(Axis{}, -3, 7, 66), -3.75, 7.5, {{0, "0"}, {5, "5"}});
  EXPECT_TRUE(chooseTicks(Axis{}, 0, 1, 150).minor.empty());
}

TEST(ChooseTicks, KeepEndsThatAreOnTicksAlready) {
  const AxisTicks ticks = chooseTicks(Axis{}, 0.3, 0.9, 66);  // 0.3 / 0.05 is 5.999…
  EXPECT_NEAR(ticks.from, 0.3, 1e-12);
  EXPECT_NEAR(ticks.to, 0.9, 1e-12);
}

// Two parts at least, nine at most, one in 22 pt between.
TEST(ChooseTicks, AreAsManyAsTheAxisHasRoomFor) {
  const auto partsAt = [](double length) {
    const AxisTicks ticks = chooseTicks(Axis{}, 0, 18, length);
    return ticks.major.size() - 1;
  };
  EXPECT_EQ(partsAt(10), 2u) << "18 / 2 is 10 rounded up, and the axis ends at 20";
  EXPECT_EQ(partsAt(65), 2u);
  EXPECT_EQ(partsAt(87), 2u) << "18 / 3";
  EXPECT_EQ(partsAt(88), 3u) << "18 / 4 is 5";
  EXPECT_EQ(partsAt(197), 3u) << "18 / 8 is 5";
  EXPECT_EQ(partsAt(198), 9u) << "18 / 9 is 2";
  EXPECT_EQ(partsAt(5000), 9u);
}

TEST(ChooseTicks, BetweenGivenEndsGoByThoseEnds) {
  Axis axis;
  axis.from = 0.0, axis.to = 60.0;
  expectTicks(chooseTicks(axis, 13, 14, 66), 0, 60, {{0, "0"}, {20, "20"}, {40, "40"}, {60, "60"}});
}

TEST(ChooseTicks, OfOneValueOrNoneAreAroundIt) {
  const double inf = INFINITY;
  const AxisTicks one = chooseTicks(Axis{}, 4, 4, 66), none = chooseTicks(Axis{}, inf, -inf, 66), zero = chooseTicks(Axis{}, 0, 0, 66);
  EXPECT_TRUE(one.from == 2 && one.to == 6);
  EXPECT_TRUE(none.from == -1 && none.to == 1);
  EXPECT_TRUE(zero.from == -1 && zero.to == 1);
  const AxisTicks below = chooseTicks(Axis{}, -4, -4, 66);
  EXPECT_TRUE(below.from == -6 && below.to == -2);
  const AxisTicks rounded = chooseTicks(Axis{}, 4, std::nextafter(4, 5), 66);
  EXPECT_TRUE(rounded.from == one.from && rounded.to == one.to) << "values that differ by rounding are one";
}

// Five decades on 150 pt: every second is named, the others are short marks.
TEST(ChooseTicks, OverManyDecadesNameEverySoManyOfThem) {
  const AxisTicks ticks = chooseTicks(logarithmic(), 3e-3, 40, 150);
  expectTicks(ticks, 1e-3, 100, {{1e-3, "10⁻³"}, {0.1, "10⁻¹"}, {10, "10¹"}});
  ASSERT_EQ(ticks.minor.size(), 3u);
  EXPECT_NEAR(ticks.minor[0], 1e-2, 1e-12);
  EXPECT_NEAR(ticks.minor[1], 1, 1e-12);
  EXPECT_NEAR(ticks.minor[2], 100, 1e-9);
}

TEST(ChooseTicks, OverThreeDecadesMarkWhatLiesBetween) {
  const AxisTicks ticks = chooseTicks(logarithmic(), 1.5, 600, 150);
  expectTicks(ticks, 1, 1000, {{1, "10⁰"}, {10, "10¹"}, {100, "10²"}, {1000, "10³"}});
  EXPECT_EQ(ticks.minor.size(), 3u * 8) << "2 to 9 of each decade";
}

TEST(ChooseTicks, WithinADecadeNameTwoAndFive) {
  const AxisTicks ticks = chooseTicks(logarithmic(), 0.2, 0.9, 150);
  expectTicks(ticks, 0.2, 1, {{0.2, "0.2"}, {0.5, "0.5"}, {1, "1"}});
  EXPECT_EQ(ticks.minor.size(), 6u) << "3, 4, 6, 7, 8, 9";
  EXPECT_NEAR(ticks.minor[0], 0.3, 1e-12);
  expectTicks(chooseTicks(logarithmic(), 3, 4, 150), 2, 5, {{2, "2"}, {5, "5"}});
  expectTicks(chooseTicks(logarithmic(), 6e4, 9e4, 150), 5e4, 1e5, {{5e4, "50000"}, {1e5, "10⁵"}});
  expectTicks(chooseTicks(logarithmic(), 600, 900, 150), 500, 1000, {{500, "500"}, {1000, "1000"}});
}

TEST(ChooseTicks, OnALogarithmicAxisWithoutPositiveDataAreADecade) {
  const double inf = INFINITY;
  const AxisTicks none = chooseTicks(logarithmic(), inf, -inf, 150), above = chooseTicks(logarithmic(), -3, 40, 150);
  EXPECT_NEAR(none.from, 0.1, 1e-12);
  EXPECT_NEAR(none.to, 1, 1e-12);
  EXPECT_NEAR(above.from, 1, 1e-12) << "a decade below 40 is 4";
  EXPECT_NEAR(above.to, 100, 1e-9);
  Axis turned = logarithmic();
  turned.from = 10.0, turned.to = 2.0;
  EXPECT_NEAR(chooseTicks(turned, 1, 5, 150).to, 100, 1e-9) << "ten times where it begins";
}

TEST(ChooseTicks, ThatAreNamedStandAloneAndInside) {
  for (Axis axis : {Axis{}, logarithmic()}) {
    axis.from = 1.0, axis.to = 3.0;
    axis.ticks = {{0.5, "out"}, {1, "first"}, {2.5, "middle"}, {3, "last"}, {3.5, "out"}};
    const AxisTicks ticks = chooseTicks(axis, 1, 3, 150);
    EXPECT_TRUE(ticks.minor.empty());
    EXPECT_EQ(ticks.major, (Major{{1, "first"}, {2.5, "middle"}, {3, "last"}}));
  }
}

TEST(NiceTicks, HoldBothEndsAndAnExactNought) {
  EXPECT_EQ(niceTicks(-2, 2, 4), (std::vector<double>{-2, -1, 0, 1, 2}));
  EXPECT_FALSE(std::signbit(niceTicks(-2, 2, 4)[2]));
  EXPECT_EQ(niceTicks(0, 10, 0), (std::vector<double>{0, 10})) << "one part at least";
  EXPECT_EQ(niceTicks(0, 6, 1), (std::vector<double>{0})) << "6 is 10 rounded up";
  const std::vector<double> tenths = niceTicks(0.1, 0.7, 6);
  ASSERT_EQ(tenths.size(), 7u) << "rounding loses neither end";
  EXPECT_NEAR(tenths.back(), 0.7, 1e-12);
  EXPECT_EQ(niceTicks(0, 4, 2), (std::vector<double>{0, 2, 4}));
}

TEST(TickText, OfLargeOrTinyNumbersHasAPowerOfTen) {
  EXPECT_EQ(tickText(999999, 1), "999999");
  EXPECT_EQ(tickText(1e6, 1e6), "1·10⁶");
  EXPECT_EQ(tickText(-2.5e7, 5e6), "−2.5·10⁷");
  EXPECT_EQ(tickText(3e-6, 1e-6), "3·10⁻⁶");
  EXPECT_EQ(tickText(0, 1e-6), "0");
  EXPECT_EQ(tickText(1e-5, 1e-5), "0.00001");
  EXPECT_EQ(tickText(1e12, 1e12), "1·10¹²");
}

TEST(TickText, HasAsManyDecimalsAsItsStepAndNoMinusBeforeNought) {
  EXPECT_EQ(tickText(1.5, 0.25), "1.50");
  EXPECT_EQ(tickText(3, 1), "3");
  EXPECT_EQ(tickText(-0.5, 0.5), "−0.5");
  EXPECT_EQ(tickText(-0.001, 0.01), "0.00");
  EXPECT_EQ(tickText(0.00002, 0.00002), "0.00002");
  EXPECT_EQ(tickText(1.23456789e-5, 1.23456789e-5), "0.0000123") << "seven decimals at most";
  EXPECT_EQ(tickText(7, 0), "7");
}

}  // namespace
}  // namespace reachlab::figure
