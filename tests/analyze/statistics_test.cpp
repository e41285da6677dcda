#include "sim/analyze/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reachlab::analyze {
namespace {

TEST(WilsonInterval, HasItsTextbookValues) {
  // Newcombe 1998, table I: 81 of 263 and 15 of 148 to four digits, 0 of 20 and 29 of 29.
  const struct {
    std::size_t r, n;
    double low, high;
  } cases[] = {{81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0.0000, 0.1611}, {1, 29, 0.0061, 0.1718}};
  for (const auto& c : cases) {
    const Interval i = computeWilsonInterval(c.r, c.n);
    EXPECT_NEAR(i.low, c.low, 5e-5);
    EXPECT_NEAR(i.high, c.high, 5e-5);
  }
}

TEST(WilsonInterval, HoldsTheShareAndStaysInside) {
  for (std::size_t n = 0; n <= 40; ++n)
    for (std::size_t k = 0; k <= n; ++k) {
      const Interval i = computeWilsonInterval(k, n);
      EXPECT_GE(i.low, 0);
      EXPECT_LE(i.high, 1);
      if (n > 0) {
        EXPECT_LE(i.low, static_cast<double>(k) / static_cast<double>(n));
        EXPECT_GE(i.high, static_cast<double>(k) / static_cast<double>(n));
      }
    }
}

TEST(NormalQuantile, InvertsTheDistribution) {
  EXPECT_NEAR(normalQuantile(0.975), 1.959963984540054, 1e-9);
  EXPECT_NEAR(normalQuantile(0.5), 0, 1e-12);
  for (const double p : {0.001, 0.1, 0.9, 0.9995}) EXPECT_NEAR(0.5 * std::erfc(-normalQuantile(p) / std::sqrt(2.0)), p, 1e-9);
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

TEST(DrawIndex, ReachesEveryPlaceAboutEquallyOften) {
  std::mt19937_64 random(3);
  std::vector<int> hits(7);
  for (int i = 0; i < 7000; ++i) ++hits[drawIndex(random, hits.size())];
  for (const int h : hits) EXPECT_NEAR(h, 1000, 150);  // five standard deviations of the fixed seed's draw
}

}  // namespace
}  // namespace reachlab::analyze
