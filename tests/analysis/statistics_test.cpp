#include "analysis/measures/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reachlab::analysis {
namespace {

TEST(MeanSd, LeavesOutWhatWasNotMeasured) {
  const std::vector<double> v{1, std::nan(""), 3, 5};
  const MeanSd s = computeMeanSd(v);
  EXPECT_EQ(s.count, 3u);
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.sd, 2);
}

// None or all: (1 - high)^n, or low^n, is what lies outside on that side.
TEST(BinomialInterval, OfNoneOrAllIsARootOfTheLevel) {
  for (const double level : {0.95, 0.8})
    for (const std::size_t n : {1u, 7u, 20u}) {
      const double root = std::pow((1 - level) / 2, 1.0 / static_cast<double>(n));
      const Bounds none = computeBinomialInterval(0, n, level), all = computeBinomialInterval(n, n, level);
      EXPECT_EQ(none.low, 0);
      EXPECT_NEAR(none.high, 1 - root, 1e-12);
      EXPECT_NEAR(all.low, root, 1e-12);
      EXPECT_EQ(all.high, 1);
    }
  EXPECT_EQ(computeBinomialInterval(0, 0).low, 0);
  EXPECT_EQ(computeBinomialInterval(0, 0).high, 1);
}

TEST(MeanSd, OfFewNumbersIsWhatIsKnown) {
  const MeanSd none = computeMeanSd(std::vector<double>{std::nan(""), INFINITY});
  EXPECT_TRUE(std::isnan(none.mean) && std::isnan(none.sd));
  EXPECT_EQ(none.count, 0u);
  const MeanSd one = computeMeanSd(std::vector<double>{2.5, -INFINITY});
  EXPECT_EQ(one.mean, 2.5);
  EXPECT_EQ(one.count, 1u);
  const MeanSd two = computeMeanSd(std::vector<double>{2, 5});
  EXPECT_DOUBLE_EQ(two.mean, 3.5);
  EXPECT_DOUBLE_EQ(two.sd, 3 / std::sqrt(2.0));
}

}  // namespace
}  // namespace reachlab::analysis
