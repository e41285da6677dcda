#include "analysis/conclusions/person_template.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/math/minimum_jerk.h"

namespace reachlab::analysis {
namespace {

constexpr double kWindowRate = 100, kMovementSeconds = 1, kAmplitude = 0.2;

/// Reaches of one person: the same movement, with a scatter [m/s] that grows from its beginning to its end.
std::vector<FitWindow> reaches(std::size_t trials, double scatter) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<FitWindow> windows(trials);
  for (FitWindow& window : windows) {
    window.rate = kWindowRate;
    window.begin = 3;
    const double phase = 3 * normal(random), size = normal(random);
    for (int k = 0; k < 160; ++k) {
      const double s = (k / kWindowRate - 0.3) / kMovementSeconds;
      const double noise = s < 0 || s > 1 ? 0 : scatter * s * size * std::sin(12 * s + phase);
      window.velocity.push_back(kAmplitude / kMovementSeconds * heldMinimumJerk(s).rate + noise);
    }
    window.weight.assign(window.velocity.size(), 1.0);
  }
  return windows;
}

TEST(PersonTemplate, TellsHowWellTheOtherTrialsDescribeOne) {
  double before = 1;
  for (const double scatter : {0.001, 0.02, 0.08}) {
    std::vector<FitWindow> windows = reaches(10, scatter);
    const PersonTemplate own = makeTemplate(windows, std::vector<double>(windows.size(), kMovementSeconds));
    EXPECT_LT(own.ceiling, before) << scatter;
    EXPECT_GT(own.ceiling, 0.2) << scatter;
    if (scatter == 0.001) {
      EXPECT_GT(own.ceiling, 0.999);
    }
    before = own.ceiling;
  }
}

// Noise that changes at every sample leaves nearly all samples their own; a slow wave few.
TEST(PersonTemplate, CountsSamplesByHowAlikeNeighboursAre) {
  const auto effectiveWith = [](double perSample) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    std::vector<FitWindow> windows = reaches(12, 0);
    for (FitWindow& window : windows) {
      const double phase = 3 * normal(random), size = normal(random);
      for (std::size_t k = 0; k < window.velocity.size(); ++k)
        window.velocity[k] += perSample * normal(random) + (0.02 - perSample) * size * std::sin(0.15 * static_cast<double>(k) + phase);
    }
    return makeTemplate(windows, std::vector<double>(windows.size(), kMovementSeconds)).effectiveSamples;
  };
  EXPECT_GT(effectiveWith(0.02), 80) << "of 160";
  EXPECT_LT(effectiveWith(0.02), 161);
  EXPECT_LT(effectiveWith(0), 15);
  EXPECT_GT(effectiveWith(0), 1);
}

// The longer a trial, the later its peak. The mean of the others misses that, and the line over the duration does not.
TEST(PersonTemplate, DescribesAShapeThatChangesWithTheDuration) {
  std::vector<FitWindow> windows;
  std::vector<double> durations;
  for (int i = 0; i < 12; ++i) {
    const double T = 0.8 * std::pow(1.04, (5 * i) % 12);
    FitWindow window;
    window.rate = kWindowRate;
    window.begin = 3;
    for (int k = 0; k < (T + 0.6) * kWindowRate; ++k) {
      const double s = (k / kWindowRate - 0.3) / T, inside = s > 0 && s < 1 ? 1 : 0;
      window.velocity.push_back(0.2 / T *
                                (heldMinimumJerk(s).rate - inside * 3 * std::log(T) * std::pow(std::sin(std::numbers::pi * s), 2) *
                                                               std::sin(4 * std::numbers::pi * s)));
    }
    window.weight.assign(window.velocity.size(), 1.0);
    windows.push_back(window);
    durations.push_back(T);
  }
  const PersonTemplate own = makeTemplate(windows, durations);
  double left = 0, whole = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) left += std::exp(own.score[i]), whole += restCost(windows[i]);
  EXPECT_LT(left, 0.2 * (1 - own.ceiling) * whole);
  EXPECT_LT(own.ceiling, 0.999) << "the mean of the others describes it badly";
}

}  // namespace
}  // namespace reachlab::analysis
