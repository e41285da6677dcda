#include "analysis/conclusions/systematic_rest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reachlab::analysis {
namespace {

constexpr std::size_t kPhases = 141;

/// Trials whose residuals are a smooth scatter, `common` in every trial, and `growing` times the logarithm of the duration.
struct Trials {
  LaidResiduals residuals;
  std::vector<double> durations;
};
Trials made(std::mt19937_64& random, std::size_t n, double common, double growing) {
  std::normal_distribution<double> normal;
  Trials out;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = 0.05 * normal(random);
    std::vector<double> r(kPhases);
    for (int wave = 1; wave <= 8; ++wave) {
      const double size = normal(random) / wave;
      for (std::size_t k = 0; k < kPhases; ++k) r[k] += size * std::sin(M_PI * wave * static_cast<double>(k) / 140);
    }
    for (std::size_t k = 0; k < kPhases; ++k) r[k] += (common + growing * x / 0.05) * std::sin(3 * M_PI * static_cast<double>(k) / 140);
    out.residuals.push_back(r);
    out.durations.push_back(1.3 * std::exp(x));
  }
  return out;
}

double shareBelow(double level, double common, double growing, std::size_t trials = 30) {
  std::mt19937_64 random(3);
  constexpr int kSets = 1500;
  int below = 0;
  for (int i = 0; i < kSets; ++i) {
    Trials t = made(random, trials, common, growing);
    below += computeSystematicRest(std::move(t.residuals), std::move(t.durations)).p() < level;
  }
  return static_cast<double>(below) / kSets;
}

// 1500 sets: the standard error of a share of 5 % is 0.6 %.
TEST(SystematicRest, OfARightFitIsFoundAsOftenAsTheLevelSays) {
  EXPECT_NEAR(shareBelow(0.05, 0, 0), 0.05, 0.018);
  EXPECT_NEAR(shareBelow(0.02, 0, 0), 0.02, 0.011);
}

TEST(SystematicRest, IsFoundInTheMeanAndInWhatGrowsWithTheDuration) {
  EXPECT_GT(shareBelow(0.02, 0.8, 0), 0.9);
  EXPECT_GT(shareBelow(0.02, 0, 0.8), 0.9);
}

// A tenth of the mean square is the same in every trial.
TEST(SystematicRest, IsThatPartOfTheMeanSquare) {
  std::mt19937_64 random(5);
  double sum = 0;
  const double square = 70 * 0.25, scatter = 70 * (1 + 1.0 / 4 + 1.0 / 9 + 1.0 / 16 + 1.0 / 25 + 1.0 / 36 + 1.0 / 49 + 1.0 / 64);
  for (int i = 0; i < 400; ++i) {
    Trials t = made(random, 30, 0.5, 0);
    sum += computeSystematicRest(std::move(t.residuals), std::move(t.durations)).share / 400;
  }
  EXPECT_NEAR(sum, square / (square + scatter), 0.008);
}

TEST(SystematicRest, OfALongSeriesIsThatOfMeansOfConsecutiveTrials) {
  std::mt19937_64 random(7);
  Trials t = made(random, 900, 0.1, 0);
  const SystematicRest rest = computeSystematicRest(t.residuals, t.durations);
  EXPECT_LT(rest.p(), 0.001);
  EXPECT_NEAR(rest.share, 0.0065, 0.006);
  EXPECT_EQ(computeSystematicRest({t.residuals[0], t.residuals[1]}, {1, 1}).p(), 1) << "too few to tell";
  EXPECT_EQ(computeSystematicRest(LaidResiduals(10, std::vector<double>(kPhases, 0.0)), std::vector<double>(10, 1.0)).p(), 1)
      << "nothing is left";
}

TEST(SystematicRest, OfSeveralHasTheMeanShareAndTheCumulantsOfAMean) {
  const std::vector<SystematicRest> rests{{0.1, 0.04, 0.008}, {0.3, 0.08, 0.016}};
  const SystematicRest mean = meanOf(rests);
  EXPECT_DOUBLE_EQ(mean.share, 0.2);
  EXPECT_DOUBLE_EQ(mean.variance, 0.03);
  EXPECT_DOUBLE_EQ(mean.third, 0.003);
  EXPECT_EQ(meanOf({}).p(), 1);
  // Gamma distribution of shape 4 / skewness^2 = 4 (skewness 1), shifted: P(x > 4 + 2 z).  z = 1: Q(4, 6) = 0.1512.
  EXPECT_NEAR((SystematicRest{1, 1, 1}.p()), 0.151203882776, 1e-9);
  EXPECT_NEAR((SystematicRest{1, 1, 0}.p()), 0.158655253931, 1e-9);
}

// The mean of two fits is half-way between them, whatever the scatter is.
TEST(SharesOfOthers, AreOneHalfForTheMeanOfTwo) {
  std::mt19937_64 random(11);
  const Trials t = made(random, 60, 0, 0);
  LaidResiduals one = t.residuals, other = t.residuals;
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t k = 0; k < kPhases; ++k) {
      const double half = std::sin(5 * M_PI * static_cast<double>(k) / 140);
      one[i][k] += half, other[i][k] -= half;
    }
  const std::vector<LaidResiduals> fits{one, other};
  const auto shares = computeSharesOfOthers(fits, 0);
  ASSERT_EQ(shares.size(), 2u);
  double mean = 0;
  for (const double share : shares[1]) mean += share / 60;
  EXPECT_NEAR(mean, 0.5, 0.05);
  for (const double share : shares[0]) EXPECT_EQ(share, 0) << "the fit itself";
}

TEST(LaidResidual, IsWeighedAndOnThePhasesOfThePersonsMean) {
  FitWindow window;
  window.begin = 0.5, window.rate = 100;
  std::vector<double> residual;
  for (int i = 0; i < 200; ++i) residual.push_back(0.01 * i), window.velocity.push_back(1), window.weight.push_back(4);
  const std::vector<double> laid = layResidual(window, residual, {0.7, 1.0, 1, 0, true});
  ASSERT_EQ(laid.size(), kPhases);
  EXPECT_NEAR(laid[15], 2 * 0.2, 1e-12) << "phase 0 is 0.7 s: 0.2 s into the window";
  EXPECT_NEAR(laid[115], 2 * 1.2, 1e-12);
  EXPECT_EQ(layResidual(window, residual, {0.55, 1.0, 1, 0, true})[0], 0) << "before the window";
}

}  // namespace
}  // namespace reachlab::analysis
