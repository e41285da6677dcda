#include "sim/analyze/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reachlab::analyze {
namespace {

TEST(BinomialInterval, HasItsTextbookValues) {
  // Newcombe 1998, table I, Clopper and Pearson: four digits.
  const struct {
    std::size_t r, n;
    double low, high;
  } cases[] = {{81, 263, 0.2527, 0.3676}, {15, 148, 0.0578, 0.1617}, {0, 20, 0.0000, 0.1684}, {1, 29, 0.0009, 0.1776}};
  for (const auto& c : cases) {
    const Interval i = computeBinomialInterval(c.r, c.n);
    EXPECT_NEAR(i.low, c.low, 5e-5);
    EXPECT_NEAR(i.high, c.high, 5e-5);
  }
}

TEST(BinomialInterval, HoldsTheShareAndStaysInside) {
  for (std::size_t n = 0; n <= 40; ++n)
    for (std::size_t k = 0; k <= n; ++k) {
      const Interval i = computeBinomialInterval(k, n);
      EXPECT_GE(i.low, 0);
      EXPECT_LE(i.high, 1);
      if (n > 0) {
        EXPECT_LE(i.low, static_cast<double>(k) / static_cast<double>(n));
        EXPECT_GE(i.high, static_cast<double>(k) / static_cast<double>(n));
      }
    }
}

TEST(MeanSd, LeavesOutWhatWasNotMeasured) {
  const std::vector<double> v{1, std::nan(""), 3, 5};
  const MeanSd s = computeMeanSd(v);
  EXPECT_EQ(s.count, 3u);
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.sd, 2);
  EXPECT_TRUE(std::isnan(computeMeanSd({}).mean));
  EXPECT_TRUE(std::isnan(computeMeanSd(std::vector<double>{2.0}).sd));
}

TEST(Quantile, LiesBetweenNeighbours) {
  const std::vector<double> v{1, 2, 4, 8};
  EXPECT_DOUBLE_EQ(quantileOfSorted(v, 0), 1);
  EXPECT_DOUBLE_EQ(quantileOfSorted(v, 0.5), 3);
  EXPECT_DOUBLE_EQ(quantileOfSorted(v, 1), 8);
}

}  // namespace
}  // namespace reachlab::analyze
