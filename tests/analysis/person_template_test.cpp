#include "analysis/conclusions/person_template.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "analysis/measures/movement.h"
#include "base/math/minimum_jerk.h"

namespace reachlab::analysis {
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

TEST(PersonTemplate, TellsHowWellTheOtherTrialsDescribeOne) {
  double before = 1;
  for (const double scatter : {0.001, 0.02, 0.08}) {
    std::vector<FitWindow> windows = reaches(10, scatter);
    const PersonTemplate own = makeTemplate(windows, std::vector<double>(windows.size(), kDuration));
    EXPECT_LT(own.ceiling, before) << scatter;
    EXPECT_GT(own.ceiling, 0.2) << scatter;
    if (scatter == 0.001) {
      EXPECT_GT(own.ceiling, 0.999);
    }
    before = own.ceiling;
  }
}

/// The same movement shifted, stretched and scaled by what is told of each trial.
std::vector<FitWindow> copies(const std::vector<std::array<double, 3>>& places) {
  std::vector<FitWindow> windows;
  for (const auto& [onset, duration, amplitude] : places) {
    FitWindow& window = windows.emplace_back();
    window.rate = 200;
    window.begin = onset - 0.4;
    for (int k = 0; k < 400; ++k) {
      const double s = (window.begin + k / window.rate - onset) / duration;
      window.velocity.push_back(s < 0 || s > 1 ? 0 : amplitude * 105 * std::pow(s, 4) * std::pow(1 - s, 2) * s);
    }
    window.weight.assign(window.velocity.size(), 7.0);
  }
  return windows;
}

TEST(PersonTemplate, LaysCopiesOfOneMovementExactlyOverOneAnother) {
  const std::vector<std::array<double, 3>> places{{3, 0.8, 0.2}, {1.5, 1, 0.3}, {2.25, 1.1, 0.25}};
  std::vector<FitWindow> windows = copies(places);
  const std::vector<double> durations{0.7, 0.9, 1.1};
  const PersonTemplate own = makeTemplate(windows, durations);
  double product = 1, amplitudes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(own.place[i].duration / own.place[0].duration, places[i][1] / 0.8, 1e-4) << i;
    EXPECT_NEAR(own.place[i].amplitude / own.place[0].amplitude, places[i][2] / 0.2, 1e-4) << i;
    const double s = (places[i][0] - own.place[i].onset) / own.place[i].duration;  // where the movement begins on the template
    EXPECT_NEAR(s, (places[0][0] - own.place[0].onset) / own.place[0].duration, 1e-4) << i;
    product *= own.place[i].duration, amplitudes += own.place[i].amplitude / 3;
  }
  EXPECT_NEAR(std::cbrt(product), 0.9, 1e-9) << "the trials' own mean duration";
  EXPECT_NEAR(amplitudes, 1, 1e-9);
  EXPECT_GT(own.ceiling, 0.9999);
  EXPECT_LT(own.ceiling, 1.0 + 1e-12);
  EXPECT_LT(own.ceilingScore, std::log(1e-4 * restCost(windows[0])));
  EXPECT_DOUBLE_EQ(own.mean.first, -0.6);
  EXPECT_DOUBLE_EQ(own.mean.step, 0.005);
  EXPECT_EQ(own.mean.value.size(), 441u) << "from -0.6 to 1.6";
  EXPECT_EQ(own.scatter.size(), 441u);
  EXPECT_TRUE(own.mean.change.empty());
  EXPECT_TRUE(own.apart.empty());
  // The mean is the movement itself, laid over the first trial.
  const double scale = own.place[0].amplitude;
  for (const double t : {3.2, 3.5, 3.7})
    EXPECT_NEAR(scale * own.mean.at((t - own.place[0].onset) / own.place[0].duration),
                windows[0].velocity[static_cast<std::size_t>(std::lround((t - 2.6) * 200))], 2e-4)
        << t;
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
    return makeTemplate(windows, std::vector<double>(windows.size(), kDuration)).effectiveSamples;
  };
  EXPECT_GT(effectiveWith(0.02), 80) << "of 160";
  EXPECT_LT(effectiveWith(0.02), 161);
  EXPECT_LT(effectiveWith(0), 15);
  EXPECT_GT(effectiveWith(0), 1);
  EXPECT_EQ(PersonTemplate{}.effectiveSamples, 1);
}

// R^2 and score by the mean of the others, by their definition: two trials, each described by the other.
TEST(PersonTemplate, DescribesEachOfTwoByTheOther) {
  std::vector<FitWindow> windows = reaches(2, 0.06);
  const PersonTemplate own = makeTemplate(windows, std::vector<double>(2, kDuration));
  double left = 0, whole = 0, score = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    Profile other;
    other.first = own.mean.first, other.step = own.mean.step;
    const MovementFit& place = own.place[1 - i];
    for (std::size_t k = 0; k < own.mean.value.size(); ++k) {
      const double t = place.onset + place.duration * (own.mean.first + own.mean.step * static_cast<double>(k)) - windows[1 - i].begin;
      const bool there = t >= 0 && t <= 1.59;
      other.value.push_back(there ? smoothValueAt(windows[1 - i].velocity, kRate, t) / place.amplitude : 0);
    }
    const MovementFit fit = fitMovement(windows[i], other, own.place[i]);
    left += fit.cost, whole += restCost(windows[i]), score += std::log(fit.cost) / 2;
  }
  EXPECT_NEAR(own.ceiling, 1 - left / whole, 1e-6);
  EXPECT_NEAR(own.ceilingScore, score, 1e-5);
}

}  // namespace
}  // namespace reachlab::analysis
