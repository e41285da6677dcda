#include "analysis/measures/smoothness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace reachlab::analysis {
namespace {

TEST(Smoothness, NeedsSamplesARateAndFiniteSpeeds) {
  const std::vector<double> bell{0, 2, 5, 1}, one{3}, infinite{0, INFINITY, 1};
  EXPECT_TRUE(std::isnan(computeSparc(one, 100)));
  EXPECT_TRUE(std::isnan(computeSparc(infinite, 100)));
  for (const double rate : {0.0, -100.0, std::nan("")}) {
    EXPECT_TRUE(std::isnan(computeSparc(bell, rate)));
    EXPECT_TRUE(std::isnan(computeLogDimensionlessJerk(bell, rate)));
  }
  EXPECT_TRUE(std::isnan(computeLogDimensionlessJerk(std::vector<double>{1, 2, 3, 4}, 100))) << "no jerk, no logarithm";
  EXPECT_TRUE(std::isnan(computeLogDimensionlessJerk(infinite, 100)));
}

// 6 stands 1 above the higher of the valleys that part it from 10 and 9; mirrored it is the same.
TEST(CountPeaks, MeasuresAProminenceFromTheHigherValley) {
  for (const std::vector<double>& v : {std::vector<double>{0, 10, 4, 6, 5, 9, 0}, std::vector<double>{0, 9, 5, 6, 4, 10, 0}}) {
    EXPECT_EQ(countPeaks(v, 0.1), 3u);
    EXPECT_EQ(countPeaks(v, 0.1001), 2u);
    EXPECT_EQ(countPeaks(v, 0.4), 2u);
    EXPECT_EQ(countPeaks(v, 0.41), 2u) << "9 goes down to 4 before it goes up to 10";
    EXPECT_EQ(countPeaks(v, 0.51), 1u);
  }
}

TEST(CountPeaks, LeavesOutShouldersEndsAndWhatIsNotAboveZero) {
  EXPECT_EQ(countPeaks(std::vector<double>{2, 1, 2}), 0u);
  EXPECT_EQ(countPeaks(std::vector<double>{0, 1, 1}), 0u);
  EXPECT_EQ(countPeaks(std::vector<double>{0, 1, 1, 2, 0}), 1u);
  EXPECT_EQ(countPeaks(std::vector<double>{0, 2, 1, 1, 0}), 1u);
  EXPECT_EQ(countPeaks(std::vector<double>{-2, -1, -2}, 0.0), 0u);
  EXPECT_EQ(countPeaks(std::vector<double>{0, 20, 18.5, 19, 0}), 1u) << "0.5 is less than 5 % of 20";
  EXPECT_EQ(countPeaks(std::vector<double>{0, 20, 18, 19.5, 0}), 2u) << "1.5 is more";
}

}  // namespace
}  // namespace reachlab::analysis
