#include "network/link_check/growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace reachlab::network {
namespace {

// Half a second after it was let be a second is looked at, and the last one; a moment on a bound is in neither.
TEST(Growth, IsTheSpeedOfTheLastSecondOverThatOfAnEarlyOne) {
  Growth growth(2, 10);
  for (const auto& [t, squares] : {std::pair{2.25, 1e6}, {2.5, 1e6}, {2.75, 4.0}, {3.25, 8.0}, {3.5, 1e6}, {5.0, 1e6}, {9.0, 1e6}})
    growth.add(t, squares);
  for (const auto& [t, squares] : {std::pair{9.25, 20.0}, {9.5, 24.0}, {9.75, 28.0}}) growth.add(t, squares);
  EXPECT_NEAR(growth.ratio(), 2, 1e-9) << "the root of 24 over 6";
}

TEST(Growth, OfAnObjectThatHardlyMovesIsNotTheRatioOfTwoNoises) {
  Growth still(0, 10), begun(0, 10);
  still.add(1, 0);
  still.add(9.5, 0);
  EXPECT_EQ(still.ratio(), 0);
  begun.add(9.5, 4e-12);
  EXPECT_NEAR(begun.ratio(), 2, 1e-9) << "1e-6 m/s are rest";
  EXPECT_EQ(Growth(0, 10).ratio(), 0) << "where nothing was looked at";
}

TEST(Growth, MayBeAFewHundredthsOrAThirdOfWhatTheObjectDoesAlone) {
  for (const double alone : {0.0, 0.5}) {
    EXPECT_TRUE(Growth::isStable(1.049, alone));
    EXPECT_FALSE(Growth::isStable(1.051, alone));
  }
  EXPECT_TRUE(Growth::isStable(2.59, 2));
  EXPECT_FALSE(Growth::isStable(2.61, 2));
  EXPECT_FALSE(Growth::isStable(std::nan(""), 2));
  EXPECT_FALSE(Growth::isStable(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()));
}

}  // namespace
}  // namespace reachlab::network
