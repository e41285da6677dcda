#include "analysis/measures/filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/fault.h"
#include "tests/refusal.h"

namespace reachlab::analysis {
namespace {

TEST(Differentiate, NeedsThreeSamplesAndNoMore) {
  EXPECT_EQ(differentiate(std::vector<double>{0, 1, 4}, 10)[1], 20);
  EXPECT_EQ(differentiate(std::vector<double>{0, 1}, 10), std::vector<double>(2, 0.0));
}

TEST(LowPass, SaysWhichCutOffItRefuses) {
  const std::vector<double> x(20, 0.0);
  EXPECT_NO_THROW(lowPass(x, 100, 49.9));
  for (const auto& [rate, cutoff] : {std::pair{100.0, std::nan("")}, {100.0, 50.0}, {INFINITY, 10.0}, {std::nan(""), 10.0}})
    EXPECT_THROW(lowPass(x, rate, cutoff), FaultError) << rate << " " << cutoff;
  EXPECT_NE(refusalOf([&] { lowPass(x, 90, 45); }).find("is 45 Hz at 90 samples per second"), std::string::npos);
}

// Of t^2 every rule of second order is exact; of t^3 the one next to the ends is off by the square of the spacing.
TEST(Differentiate, IsOfSecondOrderAtTheEnds) {
  for (const std::size_t n : {3u, 4u, 5u, 9u}) {
    std::vector<double> square, cube;
    for (std::size_t i = 0; i < n; ++i) {
      const double t = 0.25 * static_cast<double>(i);
      square.push_back(3 + t - t * t), cube.push_back(t * t * t);
    }
    const std::vector<double> v = differentiate(square, 4), w = differentiate(cube, 4);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(v[i], 1 - 0.5 * static_cast<double>(i), 1e-12) << i << " of " << n;
    EXPECT_NEAR(w[1], 3 * 0.25 * 0.25 + 0.25 * 0.25, 1e-12) << n;
    for (std::size_t i = 2; i + 2 < n; ++i) EXPECT_NEAR(w[i], 3 * std::pow(0.25 * static_cast<double>(i), 2), 1e-12) << i << " of " << n;
  }
}

}  // namespace
}  // namespace reachlab::analysis
