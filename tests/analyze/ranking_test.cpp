#include "sim/analyze/ranking.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reachlab::analyze {
namespace {

/// Trials of `subjects` whose mean squared errors scatter about `base` of each criterion, the scatter common to all (as noise of a
/// movement is) but for `own`.
std::vector<TrialErrors> makeTrials(int subjects, int trials, const std::vector<double>& base, double own, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<TrialErrors> out;
  for (int s = 0; s < subjects; ++s)
    for (int t = 0; t < trials; ++t) {
      const double common = std::exp(0.3 * normal(random));
      TrialErrors trial{"S" + std::to_string(s), {}, 101};
      for (const double b : base) trial.squares.push_back(101 * b * b * common * std::exp(own * normal(random)));
      out.push_back(trial);
    }
  return out;
}

TEST(RmsError, IsThePapersFormula) {
  const std::vector<double> a{0, 1, 2, 3}, b{0, 1, 2, 7};
  EXPECT_DOUBLE_EQ(computeRmsError(a, b), 2);
  EXPECT_TRUE(std::isnan(computeRmsError({}, {})));
}

TEST(Ranking, PutsTheNearestFirstAndSaysThatItIsApart) {
  const auto trials = makeTrials(3, 20, {0.03, 0.02, 0.05}, 0.05, 1);
  for (const Ranking& ranking : {rankOverTrials(trials, {}), *rankOverSubjects(trials, {})}) {
    ASSERT_EQ(ranking.places.size(), 3u);
    EXPECT_EQ(ranking.places[0].criterion, 1u);
    EXPECT_EQ(ranking.places[1].criterion, 0u);
    EXPECT_TRUE(ranking.decided());
    EXPECT_DOUBLE_EQ(ranking.places[0].firstShare, 1);
    for (const RankedCriterion& p : ranking.places) {
      EXPECT_LE(p.interval.low, p.epsilon);
      EXPECT_GE(p.interval.high, p.epsilon);
    }
  }
}

TEST(Ranking, CannotTellEqualCriteriaApart) {
  const auto scattered = makeTrials(3, 20, {0.02, 0.02, 0.05}, 0.3, 2);
  const Ranking ranking = rankOverTrials(scattered, {});
  EXPECT_FALSE(ranking.decided());
  EXPECT_FALSE(ranking.places[1].apartFromFirst);
  EXPECT_TRUE(ranking.places[2].apartFromFirst);
  const Ranking same = rankOverTrials(makeTrials(2, 10, {0.02, 0.02}, 0, 3), {});
  EXPECT_DOUBLE_EQ(same.places[1].difference, 0);
  EXPECT_FALSE(same.decided());
}

TEST(Ranking, IsTheSameForTheSameSeedWhateverTheOrderOfSubjects) {
  const auto trials = makeTrials(4, 9, {0.03, 0.031}, 0.2, 4);
  const Ranking a = rankOverTrials(trials, {}), b = rankOverTrials(trials, {});
  EXPECT_EQ(a.places[1].differenceInterval.low, b.places[1].differenceInterval.low);
  RankingOptions other;
  other.seed = 2;
  EXPECT_NE(a.places[1].differenceInterval.low, rankOverTrials(trials, other).places[1].differenceInterval.low);
}

TEST(Ranking, CoversTheTruthAboutAsOftenAsItSays) {
  int held = 0;
  const int studies = 200;
  RankingOptions options;
  options.resamples = 400;
  for (int s = 0; s < studies; ++s) {
    const auto trials = makeTrials(1, 60, {0.03}, 0.2, 1000 + static_cast<std::uint64_t>(s));
    const double truth = 0.03 * std::exp((0.3 * 0.3 + 0.2 * 0.2) / 4);  // root of the mean of log-normal squares
    const Interval i = rankOverTrials(trials, options).places[0].interval;
    held += i.low <= truth && truth <= i.high;
  }
  EXPECT_GE(held, 0.88 * studies);  // percentile intervals of 60 trials cover a little less than 95 %
  EXPECT_LE(held, 0.99 * studies);
}

TEST(Ranking, OfOneOrNoTrialTellsNothingApart) {
  EXPECT_TRUE(rankOverTrials({}, {}).places.empty());
  const auto one = makeTrials(1, 1, {0.02, 0.05}, 0, 5);
  const Ranking ranking = rankOverTrials(one, {});
  EXPECT_FALSE(ranking.decided());
  EXPECT_FALSE(rankOverSubjects(one, {}).has_value());
}

}  // namespace
}  // namespace reachlab::analyze
