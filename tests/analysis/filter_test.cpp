#include "analysis/measures/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "tests/refusal.h"

namespace reachlab::analysis {
namespace {

TEST(LowPass, AgreesWithAnIndependentImplementation) {
  // scipy.signal: b, a = butter(2, 10/50); filtfilt(b, a, x) with x = sin(0.3 i) + 0.1 i^1.1, i = 0 … 29
  std::vector<double> x;
  for (int i = 0; i < 30; ++i) x.push_back(std::sin(0.3 * i) + 0.1 * std::pow(i, 1.1));
  const std::vector<double> y = lowPass(x, 100, 10);
  const std::pair<std::size_t, double> expected[] = {{0, -0.00048064439796959013}, {1, 0.391238328453585},  {7, 1.673843187994375},
                                                     {15, 1.0326692749422177},     {28, 4.701033694560048}, {29, 4.732836361743194}};
  for (const auto& [i, value] : expected) EXPECT_NEAR(y[i], value, 1e-13) << i;  // rounding of a few dozen operations
}

TEST(Differentiate, IsExactForPolynomialsOfItsOrder) {
  std::vector<double> x;
  for (int i = 0; i < 40; ++i) x.push_back(std::pow(0.01 * i, 4) - 2 * std::pow(0.01 * i, 2));
  const std::vector<double> v = differentiate(x, 100);
  for (std::size_t i = 2; i < 38; ++i) {
    const double t = 0.01 * static_cast<double>(i);
    EXPECT_NEAR(v[i], 4 * t * t * t - 4 * t, 1e-12);
  }
}

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
