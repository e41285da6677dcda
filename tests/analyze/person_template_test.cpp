#include "sim/analyze/person_template.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/minimum_jerk.h"

namespace reachlab::analyze {
namespace {

constexpr double kRate = 100, kDuration = 1, kAmplitude = 0.2;

/// Reaches of one person: the same movement, with a scatter [m/s] that grows from its beginning to its end.
std::vector<FitWindow> reaches(std::size_t trials, double scatter) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<FitWindow> windows(trials);
  for (FitWindow& window : windows) {
    window.rate = kRate;
    window.begin = 3;
    const double phase = 3 * normal(random), size = normal(random);
    for (int k = 0; k < 160; ++k) {
      const double s = (k / kRate - 0.3) / kDuration;
      const double noise = s < 0 || s > 1 ? 0 : scatter * s * size * std::sin(12 * s + phase);
      window.velocity.push_back(kAmplitude / kDuration * heldMinimumJerk(s).rate + noise);
    }
    window.weight.assign(window.velocity.size(), 1.0);
  }
  return windows;
}

TEST(PersonTemplate, WeighsASampleByTheScatterOnEitherSideOfIt) {
  std::vector<FitWindow> windows = reaches(12, 0.05);
  const PersonTemplate own = makeTemplate(windows, std::vector<double>(windows.size(), kDuration));
  const double least = 0.1 * *std::max_element(own.scatter.begin(), own.scatter.end());
  double smallest = 1e300, greatest = 0;
  for (std::size_t trial = 0; trial < windows.size(); ++trial)
    for (std::size_t k = 0; k < windows[trial].weight.size(); ++k) {
      const double t = windows[trial].begin + static_cast<double>(k) / kRate;
      const double s = (t - own.place[trial].onset) / own.place[trial].duration;
      const double x = std::clamp((s - own.mean.first) / own.mean.step, 0.0, static_cast<double>(own.scatter.size() - 2));
      const auto [low, high] = std::minmax(own.scatter[static_cast<std::size_t>(x)], own.scatter[static_cast<std::size_t>(x) + 1]);
      EXPECT_GE(windows[trial].weight[k], (1 - 1e-9) * std::pow(std::max(high, least), -2)) << trial << " " << k;
      EXPECT_LE(windows[trial].weight[k], (1 + 1e-9) * std::pow(std::max(low, least), -2)) << trial << " " << k;
      smallest = std::min(smallest, windows[trial].weight[k]);
      greatest = std::max(greatest, windows[trial].weight[k]);
    }
  EXPECT_GT(greatest, 4 * smallest) << "the beginning counts for more than the end";
}

TEST(PersonTemplate, TellsHowWellTheOtherTrialsDescribeOne) {
  double before = 1;
  for (const double scatter : {0.001, 0.02, 0.08}) {
    std::vector<FitWindow> windows = reaches(10, scatter);
    const PersonTemplate own = makeTemplate(windows, std::vector<double>(windows.size(), kDuration));
    EXPECT_LT(own.ceiling, before) << scatter;
    EXPECT_GT(own.ceiling, 0.2) << scatter;
    if (scatter == 0.001) EXPECT_GT(own.ceiling, 0.999);
    before = own.ceiling;
  }
}

}  // namespace
}  // namespace reachlab::analyze
