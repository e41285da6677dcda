#include "sim/analyze/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/fault.h"

namespace reachlab::analyze {
namespace {

std::vector<double> tone(double frequency, double rate, std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::sin(2 * std::numbers::pi * frequency * static_cast<double>(i) / rate);
  return x;
}

TEST(LowPass, AgreesWithAnIndependentImplementation) {
  // scipy.signal: b, a = butter(2, 10/50); filtfilt(b, a, x) with x = sin(0.3 i) + 0.1 i^1.1, i = 0 … 29
  std::vector<double> x;
  for (int i = 0; i < 30; ++i) x.push_back(std::sin(0.3 * i) + 0.1 * std::pow(i, 1.1));
  const std::vector<double> y = lowPass(x, 100, 10);
  const std::pair<std::size_t, double> expected[] = {{0, -0.00048064439796959013}, {1, 0.391238328453585},  {7, 1.673843187994375},
                                                     {15, 1.0326692749422177},     {28, 4.701033694560048}, {29, 4.732836361743194}};
  for (const auto& [i, value] : expected) EXPECT_NEAR(y[i], value, 1e-13) << i;  // rounding of a few dozen operations
}

TEST(LowPass, PassesAConstantUnchanged) {
  for (const double v : lowPass(std::vector<double>(50, 0.37), 100, 10)) EXPECT_NEAR(v, 0.37, 1e-14);
}

TEST(LowPass, HalvesTheAmplitudeAtTheCutOffAndDelaysNothing) {
  for (const double cutoff : {5.0, 10.0, 20.0}) {
    const std::vector<double> x = tone(cutoff, 1000, 4000), y = lowPass(x, 1000, cutoff);
    // Away from the ends, where the extension is not a sine. Each pass has 1/sqrt 2, so together 1/2, in phase.
    for (std::size_t i = 1500; i < 2500; ++i) EXPECT_NEAR(y[i], 0.5 * x[i], 1e-9);
  }
}

TEST(LowPass, IsTheSameForwardsAndBackwards) {
  std::vector<double> x = tone(3, 100, 120);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += 1e-3 * static_cast<double>((i * 7919) % 101);
  const std::vector<double> forward = lowPass(x, 100, 8);
  const std::vector<double> backward = lowPass(std::vector<double>(x.rbegin(), x.rend()), 100, 8);
  // Not exactly: the pass that comes second starts from what the first left at the end. Away from the ends it has died out.
  for (std::size_t i = 40; i < 80; ++i) EXPECT_NEAR(forward[i], backward[x.size() - 1 - i], 1e-7);
}

TEST(LowPass, RefusesACutOffBeyondHalfTheRate) {
  const std::vector<double> x(20, 0.0);
  EXPECT_THROW(lowPass(x, 100, 50), FaultError);
  EXPECT_THROW(lowPass(x, 100, -1), FaultError);
  EXPECT_EQ(lowPass(x, 100, 0), x);
}

TEST(LowPass, BearsSignalsOfAnyLength) {
  for (std::size_t n = 0; n < 12; ++n) {
    const std::vector<double> y = lowPass(std::vector<double>(n, 1.0), 100, 10);
    ASSERT_EQ(y.size(), n);
    for (const double v : y) EXPECT_NEAR(v, 1, 1e-14);
  }
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

}  // namespace
}  // namespace reachlab::analyze
