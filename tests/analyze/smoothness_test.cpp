#include "sim/analyze/smoothness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace reachlab::analyze {
namespace {

constexpr double kPublishedDigits = 5e-6;  // the known values are given to five decimals

std::vector<double> gaussian() {  // exp(-5 t^2), t = -1 … 0.99, step 0.01
  std::vector<double> v;
  for (int i = 0; i < 200; ++i) v.push_back(std::exp(-5 * std::pow(-1 + 0.01 * i, 2)));
  return v;
}

std::vector<double> minimumJerk(double duration, double rate) {  // 0.2 m
  std::vector<double> v;
  const int n = static_cast<int>(std::lround(duration * rate));
  for (int i = 0; i <= n; ++i) {
    const double s = static_cast<double>(i) / n;
    v.push_back(30 * 0.2 / duration * s * s * (1 - s) * (1 - s));
  }
  return v;
}

TEST(Sparc, HasItsKnownValues) {
  EXPECT_NEAR(computeSparc(gaussian(), 100), -1.41403, kPublishedDigits);
  EXPECT_NEAR(computeSparc(minimumJerk(1.35, 100), 100), -1.40255, kPublishedDigits);
}

TEST(LogDimensionlessJerk, HasItsKnownValues) {
  EXPECT_NEAR(computeLogDimensionlessJerk(gaussian(), 100), -5.81636, kPublishedDigits);
  EXPECT_NEAR(computeLogDimensionlessJerk(minimumJerk(1.35, 100), 100), -5.30722, kPublishedDigits);
}

TEST(Smoothness, DoesNotDependOnAmplitude) {
  std::vector<double> v = minimumJerk(1.35, 100);
  const double sparc = computeSparc(v, 100), ldlj = computeLogDimensionlessJerk(v, 100);
  for (double& x : v) x *= 3.7;
  EXPECT_NEAR(computeSparc(v, 100), sparc, 1e-12);
  EXPECT_NEAR(computeLogDimensionlessJerk(v, 100), ldlj, 1e-12);
}

TEST(Smoothness, FallsWithEachSubmovement) {
  double lastSparc = 0, lastJerk = 0;
  for (int parts = 1; parts <= 4; ++parts) {
    std::vector<double> v;
    for (int k = 0; k < parts; ++k) {
      const std::vector<double> one = minimumJerk(0.6, 100);
      v.insert(v.end(), one.begin(), one.end());
    }
    const double sparc = computeSparc(v, 100), jerk = computeLogDimensionlessJerk(v, 100);
    if (parts > 1) {
      EXPECT_LT(sparc, lastSparc);
      EXPECT_LT(jerk, lastJerk);
    }
    EXPECT_EQ(countPeaks(v), static_cast<std::size_t>(parts));
    lastSparc = sparc;
    lastJerk = jerk;
  }
}

TEST(Smoothness, IsNotANumberWhereItIsNotDefined) {
  EXPECT_TRUE(std::isnan(computeSparc({}, 100)));
  EXPECT_TRUE(std::isnan(computeSparc(std::vector<double>(50, 0.0), 100)));
  EXPECT_TRUE(std::isnan(computeLogDimensionlessJerk(std::vector<double>(2, 1.0), 100)));
  EXPECT_TRUE(std::isnan(computeLogDimensionlessJerk(std::vector<double>(50, 0.0), 100)));
}

TEST(CountPeaks, NeedsThreeSamplesAndNoMore) {
  EXPECT_EQ(countPeaks(std::vector<double>{0, 1, 0}), 1u);
  EXPECT_EQ(countPeaks(std::vector<double>{0, 1}), 0u);
  EXPECT_EQ(countPeaks(std::vector<double>{}), 0u);
}

TEST(CountPeaks, IgnoresRipplesBelowTheProminence) {
  std::vector<double> v = minimumJerk(1, 100);
  EXPECT_EQ(countPeaks(v), 1u);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += 0.001 * std::sin(2.0 * static_cast<double>(i));
  EXPECT_EQ(countPeaks(v), 1u);
  EXPECT_GT(countPeaks(v, 0.0), 1u);
  EXPECT_EQ(countPeaks({}), 0u);
  EXPECT_EQ(countPeaks(std::vector<double>{0, 1, 1, 1, 0}), 1u);
}

}  // namespace
}  // namespace reachlab::analyze
