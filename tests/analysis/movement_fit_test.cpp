#include "analysis/conclusions/movement_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/conclusions/fit_window.h"
#include "analysis/conclusions/near_predictions.h"

namespace reachlab::analysis {
namespace {

/// A lopsided bell on a grid of s from -0.1 to 1.1: s^3 (1 - s)^2 inside, nothing outside.
Profile lopsided() {
  Profile profile;
  profile.first = -0.1, profile.step = 0.005;
  for (int i = 0; i <= 240; ++i) {
    const double s = profile.first + profile.step * i;
    profile.value.push_back(s <= 0 || s >= 1 ? 0 : 30 * s * s * s * (1 - s) * (1 - s));
  }
  return profile;
}

FitWindow recordedWith(const Profile& profile, double onset, double duration, double amplitude) {
  FitWindow window;
  window.rate = 80;
  window.begin = 2.25;
  for (int k = 0; k < 160; ++k) {
    window.velocity.push_back(amplitude * profile.at((window.begin + k / window.rate - onset) / duration));
    window.weight.push_back(1 + 0.5 * std::sin(0.2 * k));
  }
  return window;
}

TEST(MovementFit, FindsWhatItWasMadeFrom) {
  const Profile profile = lopsided();
  const FitWindow window = recordedWith(profile, 2.7, 0.9, 0.4);
  const MovementFit start = startFrom(momentsOf(window), momentsOf(profile));
  EXPECT_NEAR(start.duration, 0.9, 1e-3);
  EXPECT_NEAR(start.onset, 2.7, 1e-3);
  for (const double factor : {0.8, 1.0, 1.25}) {
    const MovementFit fit = fitMovement(window, profile, startFrom(momentsOf(window), momentsOf(profile), factor));
    ASSERT_TRUE(fit.found);
    EXPECT_NEAR(fit.onset, 2.7, 1e-7);
    EXPECT_NEAR(fit.duration, 0.9, 1e-7);
    EXPECT_NEAR(fit.amplitude, 0.4, 1e-7);
    EXPECT_LT(fit.cost, 1e-12);
  }
}

TEST(MovementFit, OfNoStartIsNone) {
  const Profile profile = lopsided();
  const FitWindow window = recordedWith(profile, 2.7, 0.9, 0.4);
  EXPECT_FALSE(fitMovement(window, profile, MovementFit{}).found);
  MovementFit far;
  far.onset = 50, far.duration = 1;
  const MovementFit beside = fitMovement(window, profile, far);
  EXPECT_TRUE(beside.found);
  EXPECT_EQ(beside.amplitude, 0) << "what does not meet the window explains nothing";
  EXPECT_NEAR(beside.cost, restCost(window), 1e-12);
  const Profile tiny{0, 0.2, {0, 1, 2, 1, 0}, {}};
  EXPECT_EQ(fitMovement(window, tiny, far).amplitude, 0) << "too few samples for a piece";
}

/// phi = (1 + T^2) s^2 (1 - s), of second degree in T: interpolation over durations is exact.
bool growing(double duration, std::span<double> phi) {
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(phi.size() - 1);
    phi[i] = (1 + duration * duration) * s * s * (1 - s);
  }
  return duration < 3;
}

TEST(ProfileFamily, InterpolatesOverDurationsAndTellsTheirChange) {
  const ProfileFamily family(growing, RecordingFilter(0, 100), {50, 0.4, 0.03});
  Profile profile;
  for (const double T : {0.4, 0.777, 1.5}) {
    ASSERT_TRUE(family.at(T, profile));
    EXPECT_DOUBLE_EQ(profile.step, 0.02);
    EXPECT_DOUBLE_EQ(profile.first, -0.04) << "two cells for the slopes at the ends";
    ASSERT_EQ(profile.value.size(), 55u);
    ASSERT_EQ(profile.change.size(), 55u);
    for (int i = 0; i < 55; ++i) {
      const double s = 0.02 * (i - 2), shape = s < 0 || s > 1 ? 0 : s * s * (1 - s);
      EXPECT_NEAR(profile.value[static_cast<std::size_t>(i)], (1 + T * T) * shape, 1e-12);
      EXPECT_NEAR(profile.change[static_cast<std::size_t>(i)], 2 * T * T * shape, 1e-10);
    }
    EXPECT_LT(family.errorAt(T), 1e-12);
  }
  EXPECT_FALSE(family.at(0.39, profile)) << "shorter than the grid holds";
  EXPECT_FALSE(family.at(2.95, profile)) << "one of the durations around it cannot be predicted";
  EXPECT_FALSE(family.at(19992 * 0.03, profile)) << "beyond all durations";
  EXPECT_FALSE(family.at(std::nan(""), profile));
  EXPECT_EQ(family.errorAt(2.95), 1);
  EXPECT_EQ(family.errorAt(5), 1);
}

TEST(ProfileFamily, TellsTheErrorOfWhatItInterpolates) {
  const auto kinked = [](double duration, std::span<double> phi) {
    std::fill(phi.begin(), phi.end(), 2 + std::abs(duration - 1.015));
    return true;
  };
  const ProfileFamily family(kinked, RecordingFilter(0, 100), {10, 0.4, 0.03});
  Profile between;
  ASSERT_TRUE(family.at(1.015, between));
  EXPECT_NEAR(family.errorAt(1.015), std::abs(between.value[5] - 2) / 2, 1e-12);
  EXPECT_GT(family.errorAt(1.015), 1e-4);
}

// Eight durations around the first one asked for, then only what is new.
TEST(ProfileFamily, PredictsADurationOnce) {
  std::vector<double> asked;
  const ProfileFamily family(
      [&](double duration, std::span<double> phi) {
        asked.push_back(duration);
        return growing(duration, phi);
      },
      RecordingFilter(0, 100), {10, 0.1, 0.125});
  Profile profile;
  ASSERT_TRUE(family.at(1.1, profile));
  std::vector<double> expected;
  for (int i = 5; i <= 12; ++i) expected.push_back(0.125 * i);
  EXPECT_EQ(asked, expected);
  ASSERT_TRUE(family.at(1.05, profile));
  EXPECT_EQ(asked.size(), 8u);
  ASSERT_TRUE(family.at(1.2, profile));
  EXPECT_EQ(asked.size(), 9u);
  EXPECT_EQ(asked.back(), 0.125 * 13);
  ASSERT_TRUE(family.at(0.2, profile));
  EXPECT_EQ(*std::min_element(asked.begin(), asked.end()), 0.125) << "no movement lasts no time";
}

TEST(MovementFit, PlansAnewForEveryDuration) {
  const auto skewed = [](double duration, std::span<double> phi) {  // its peak comes the later the longer it lasts
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(phi.size() - 1);
      phi[i] = 30 * s * s * (1 - s) * (1 - s) * (1 + duration * (s - 0.5));
    }
    return true;
  };
  const ProfileFamily family(skewed, RecordingFilter(0, 100), {200, 0.3, 0.02});
  Profile truth, scratch;
  ASSERT_TRUE(family.at(0.85, truth));
  const FitWindow window = recordedWith(truth, 2.8, 0.85, 0.5);
  ASSERT_TRUE(family.at(1, scratch));
  const MovementFit start = startFrom(momentsOf(window), momentsOf(scratch));
  const MovementFit fit = fitMovement(window, family, start, scratch);
  ASSERT_TRUE(fit.found);
  EXPECT_NEAR(fit.onset, 2.8, 1e-6);
  EXPECT_NEAR(fit.duration, 0.85, 1e-6);
  EXPECT_NEAR(fit.amplitude, 0.5, 1e-6);
  MovementFit shorter = start;
  shorter.duration = 0.2;
  EXPECT_FALSE(fitMovement(window, family, shorter, scratch).found);
}

/// Velocity 2 s at s of its duration, over 0.5 m.
class Ramp final : public predict::Prediction {
 public:
  explicit Ramp(double seconds) { duration = seconds, distance = 0.5, massCount_ = 1; }
  predict::PredictedHand handAt(double t) const override { return {0, 2 * t / duration, 0}; }
  void massesAt(double, std::span<double> position, std::span<double> velocity) const override { position[0] = velocity[0] = 0; }
};

TEST(NearPredictions, StartFromTheirNeighboursAtMultiplesAndFromNothingBetween) {
  std::vector<std::pair<double, std::vector<double>>> asked;  // duration, those that it was started from
  const auto sampler = sampleNearPredictions(
      [&](double duration, std::span<const predict::Prediction* const> near) -> std::unique_ptr<predict::Prediction> {
        asked.emplace_back(duration, std::vector<double>{});
        for (const predict::Prediction* p : near) asked.back().second.push_back(p->duration);
        if (duration == 1.125) return nullptr;
        return std::make_unique<Ramp>(duration);
      },
      1.3, 0.125);
  std::vector<double> phi(3);
  EXPECT_TRUE(sampler(1, phi));
  // (T / L) v(sT) = 2 s T / 0.5.
  EXPECT_NEAR(phi[1], 2, 1e-12);
  EXPECT_NEAR(phi[2], 4, 1e-12);
  ASSERT_EQ(asked.size(), 7u) << "1.3 s, and the six from 0.75 to 1.375";
  EXPECT_EQ(asked[0], (std::pair<double, std::vector<double>>{1.3, {}}));
  EXPECT_EQ(asked[1], (std::pair<double, std::vector<double>>{0.75, {1.3}}));
  EXPECT_EQ(asked[2], (std::pair<double, std::vector<double>>{0.875, {0.75}}));
  EXPECT_EQ(asked[3], (std::pair<double, std::vector<double>>{1, {0.75, 0.875}}));
  EXPECT_EQ(asked[5], (std::pair<double, std::vector<double>>{1.25, {0.75, 0.875, 1}})) << "1.125 could not be predicted";
  EXPECT_FALSE(sampler(1.125, phi));
  EXPECT_TRUE(sampler(1.375, phi));
  EXPECT_EQ(asked.size(), 7u);
  EXPECT_TRUE(sampler(1.2, phi));
  EXPECT_EQ(asked.back(), (std::pair<double, std::vector<double>>{1.2, {}}));
  EXPECT_TRUE(sampler(0.125, phi));
  EXPECT_EQ(asked.size(), 8u + 5) << "of 0 to 0.625 all but the first, and 1.3 s no more";
  EXPECT_FALSE(sampler(0, phi));
}

/// 200 samples a second, at rest until 1 s, a bell of half a second then.
TrialData trialAt(double rate, double seconds) {
  TrialData trial;
  trial.rate = rate;
  trial.first = 0.004;
  trial.hand.resize(static_cast<std::size_t>(std::lround(seconds * rate)) + 1);
  return trial;
}
TrialSignals bellAt(const TrialData& trial, double from, double duration) {
  TrialSignals signals;
  for (std::size_t i = 0; i < trial.hand.size(); ++i) {
    const double s = (static_cast<double>(i) / trial.rate - from) / duration;
    signals.handVelocity.push_back(s < 0 || s > 1 ? 0 : 16 * s * s * (1 - s) * (1 - s) * 0.3);
  }
  return signals;
}

TEST(FitWindow, BeginsBeforeTheMovementAndEndsBeforeTheRecord) {
  const TrialData trial = trialAt(200, 2);
  const TrialSignals signals = bellAt(trial, 1, 0.5);
  const auto window = makeFitWindow(trial, signals);
  ASSERT_TRUE(window);
  // 5 % of the peak are passed at 1.0298 s: the first sample above is number 206, 60 samples before it is 146.
  EXPECT_DOUBLE_EQ(window->begin, 0.004 + 146 / 200.0);
  EXPECT_DOUBLE_EQ(window->rate, 100);
  ASSERT_EQ(window->velocity.size(), 123u) << "every second one up to number 390, 10 of 401 being left out";
  for (std::size_t i = 0; i < window->velocity.size(); ++i) EXPECT_EQ(window->velocity[i], signals.handVelocity[146 + 2 * i]);
  EXPECT_EQ(window->weight, std::vector<double>(123, 1.0));
  const auto early = makeFitWindow(trial, bellAt(trial, 0.1, 0.5));
  EXPECT_DOUBLE_EQ(early->begin, 0.004) << "there is nothing before the record";
  const TrialData slow = trialAt(60, 2);
  EXPECT_DOUBLE_EQ(makeFitWindow(slow, bellAt(slow, 1, 0.5))->rate, 60);
}

TEST(FitWindow, OfTooLittleIsNone) {
  const TrialData trial = trialAt(100, 2);
  EXPECT_FALSE(makeFitWindow(trial, TrialSignals{}));
  TrialSignals still = bellAt(trial, 1, 0.5);
  for (double& v : still.handVelocity) v = -v;
  EXPECT_FALSE(makeFitWindow(trial, still)) << "nothing moved along the path";
  // 5 samples are left out at the end: 15 are enough for ten, 14 are not.
  for (const std::size_t samples : {14u, 15u}) {
    TrialData few = trialAt(100, 0);
    few.hand.resize(samples);
    EXPECT_EQ(makeFitWindow(few, bellAt(few, 0, 0.14)).has_value(), samples == 15) << samples;
  }
}

}  // namespace
}  // namespace reachlab::analysis
