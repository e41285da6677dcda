#include "analysis/conclusions/conclusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "analysis/conclusions/model_selection.h"

namespace reachlab::analysis {
namespace {

constexpr std::size_t kCandidates = 4, kReference = 3;

/// A person of `trials` whose scores of candidate `nearest` are lower by `by`; scatter of a trial 0.2.
PersonScores person(std::mt19937_64& random, std::size_t nearest, double by, std::size_t trials = 20) {
  std::normal_distribution<double> normal(0, 0.2);
  PersonScores out;
  ConditionScores scores;
  for (std::size_t c = 0; c < kCandidates; ++c) {
    std::vector<double> y;
    for (std::size_t i = 0; i < trials; ++i) y.push_back(normal(random) - (c == nearest ? by : 0));
    scores.score.push_back(y);
    scores.r2.push_back(0.99);
  }
  scores.ceiling = 0.99;
  out.conditions.push_back(scores);
  return out;
}

std::vector<PersonScores> people(std::size_t n, std::size_t nearest, double by) {
  std::mt19937_64 random(7);
  std::vector<PersonScores> out;
  for (std::size_t i = 0; i < n; ++i) out.push_back(person(random, nearest, by));
  return out;
}

TEST(Conclusion, OfOnePersonIsOverTrialsAlone) {
  const Conclusion c = concludePeople(people(1, 1, 0.6), kCandidates, kReference);
  EXPECT_FALSE(c.overSubjects);
  EXPECT_EQ(c.follows, 1u);
  EXPECT_TRUE(c.posterior.empty());
}

// 200 trials of one hand tell candidates apart whose squared errors differ by 8 %, at any level; nothing may be concluded from so little.
TEST(Conclusion, OfASmallDifferenceIsNoneHoweverSignificant) {
  std::mt19937_64 random(11);
  PersonScores one = person(random, 0, 0.5, 200);
  for (double& y : one.conditions[0].score[1]) y -= 0.42;
  const Conclusion c = concludePerson(one, kCandidates, kReference);
  EXPECT_LT(c.p, kTrialsLevel);
  EXPECT_LT(c.against[1].mean, kLeastDifference);
  EXPECT_EQ(c.reason, Obstacle::NotToldApart);
  EXPECT_NE(std::find(c.notToldApart.begin(), c.notToldApart.end(), std::pair<std::size_t, std::size_t>{0, 1}), c.notToldApart.end());
  for (double& y : one.conditions[0].score[1]) y += 0.1;
  EXPECT_EQ(concludePerson(one, kCandidates, kReference).follows, 0u);
  std::vector<PersonScores> many(8, one);
  for (std::size_t i = 0; i < many.size(); ++i)
    for (double& y : many[i].conditions[0].score[1]) y -= 0.1 + 0.001 * static_cast<double>(i);
  EXPECT_EQ(concludePeople(many, kCandidates, kReference).reason, Obstacle::NotToldApart);
}

TEST(Conclusion, OfFivePeopleWhoAgreeIsDecided) {
  const Conclusion c = concludePeople(people(5, 2, 0.8), kCandidates, kReference);
  EXPECT_EQ(c.follows, 2u);
  EXPECT_LT(c.p, kSubjectsLevel);
  EXPECT_GE(c.posterior[2], kMinExceedance);
  EXPECT_FALSE(c.signFlipP);
  EXPECT_EQ(concludePeople(people(6, 2, 0.8), kCandidates, kReference).signFlipP, 2.0 / 64);
}

// A study has no R^2, and the mean of n ones differs from one by a rounding for some n.
TEST(Conclusion, OfAnyNumberOfPeopleWhoLeaveNothingIsDecided) {
  for (std::size_t n = 5; n <= 40; ++n) {
    std::vector<PersonScores> all = people(n, 2, 0.8);
    for (PersonScores& one : all) one.conditions[0].r2.assign(kCandidates, 1), one.conditions[0].ceiling = 1;
    EXPECT_EQ(concludePeople(all, kCandidates, kReference).follows, 2u) << n;
  }
}

TEST(Conclusion, ThatTheReferenceIsAsNearIsNone) {
  EXPECT_EQ(concludePeople(people(5, kReference, 1), kCandidates, kReference).reason, Obstacle::Reference);
  EXPECT_EQ(concludePeople(people(1, kReference, 1), kCandidates, kReference).reason, Obstacle::Reference);
  EXPECT_EQ(concludePeople(people(1, 0, 0.02), kCandidates, kReference).reason, Obstacle::Reference);
}

TEST(Conclusion, OfNobodyIsTooFewTrials) {
  EXPECT_EQ(concludePeople({}, kCandidates, kReference).reason, Obstacle::TooFewTrials);
  EXPECT_EQ(concludePeople({PersonScores{}}, kCandidates, kReference).subjects, 0u);
}

// The design's table, section 5: people whose candidates are equal but for what each person happens to prefer (tau 0.3 of a trial's
// scatter), ten people, 20 trials: at most 5 % may be decided, over trials it would be a third.
TEST(Conclusion, OfEqualCandidatesIsRarelyDecidedThoughPeopleDiffer) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  int decided = 0;
  constexpr int kStudies = 400;
  for (int s = 0; s < kStudies; ++s) {
    std::vector<PersonScores> all;
    for (int i = 0; i < 10; ++i) {
      PersonScores p = person(random, 0, 0);
      for (std::size_t c = 0; c < 2; ++c) {
        const double own = 0.3 * 0.2 * normal(random) - 0.5;  // both are better than the other two
        for (double& y : p.conditions[0].score[c]) y += own;
      }
      all.push_back(std::move(p));
    }
    decided += concludePeople(all, kCandidates, kReference).decided();
  }
  EXPECT_LE(decided, kStudies * 5 / 100);
}

/// A person whose scores in a condition are a level for each candidate plus a pattern of scatter that no two candidates share.
ConditionScores levels(std::vector<double> score, std::size_t trials = 20, double scatter = 0.05) {
  ConditionScores out;
  for (std::size_t c = 0; c < score.size(); ++c) {
    std::vector<double> y;
    for (std::size_t i = 0; i < trials; ++i)
      y.push_back(score[c] + scatter * std::sin(1.7 * static_cast<double>((i + 1) * (c + 1)) + 0.3 * static_cast<double>(i * i)));
    out.score.push_back(y);
    out.r2.push_back(0.945);
  }
  out.ceiling = 0.95;
  return out;
}
double mean(const std::vector<double>& y) { return std::accumulate(y.begin(), y.end(), 0.0) / static_cast<double>(y.size()); }

TEST(Conclusion, OfAPersonWeighsConditionsAlikeWhateverTheirTrials) {
  PersonScores one{{}, {levels({-3, -1, -2, 0}, 30), levels({-1, -1.5, 0, 1}, 12)}};
  one.conditions[0].r2 = {0.8, 0.1, 0.2, 0.3};
  one.conditions[1].r2 = {0.9, 0.4, 0.5, 0.6};
  one.conditions[0].ceiling = 0.82, one.conditions[1].ceiling = 0.92;
  const Conclusion c = concludePerson(one, kCandidates, kReference);
  ASSERT_EQ(c.score.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(c.score[k], (mean(one.conditions[0].score[k]) + mean(one.conditions[1].score[k])) / 2, 1e-12) << k;
  EXPECT_EQ(c.best, 0u);
  EXPECT_EQ(c.follows, 0u);
  EXPECT_EQ(c.trials, 42u);
  EXPECT_EQ(c.subjects, 1u);
  EXPECT_NEAR(c.r2, 0.85, 1e-12);
  EXPECT_NEAR(c.ceiling, 0.87, 1e-12);
  EXPECT_EQ(c.each, std::vector<std::optional<std::size_t>>{0u});
  for (std::size_t k = 1; k < 4; ++k) EXPECT_NEAR(c.against[k].mean, c.score[k] - c.score[0], 1e-12) << k;
  EXPECT_EQ(c.against[0].p, 1) << "not against itself";
  EXPECT_EQ(c.rival, static_cast<std::size_t>(std::max_element(c.against.begin() + 1, c.against.end(),
                                                               [](const TTest& a, const TTest& b) { return a.p < b.p; }) -
                                              c.against.begin()));
  EXPECT_EQ(c.p, c.against[*c.rival].p);
  EXPECT_EQ(c.referenceP, c.against[3].p);
  EXPECT_FALSE(c.referenceFirst);
  EXPECT_TRUE(c.notToldApart.empty());
}

TEST(Conclusion, ThatTheReferenceIsBestHasNothingAgainstIt) {
  PersonScores one{{}, {levels({-1, -1.2, 0, -2})}};
  const Conclusion c = concludePerson(one, kCandidates, kReference);
  EXPECT_TRUE(c.referenceFirst);
  EXPECT_EQ(c.best, 3u);
  EXPECT_EQ(c.referenceP, 1);
  EXPECT_EQ(c.reason, Obstacle::Reference);
  EXPECT_EQ(c.each, std::vector<std::optional<std::size_t>>{std::nullopt});
}

TEST(Conclusion, NamesThePairsThatAreNotToldApart) {
  PersonScores one{{}, {levels({-3, -1, -1.05, 0})}};
  const Conclusion c = concludePerson(one, kCandidates, kReference);
  EXPECT_EQ(c.notToldApart, (std::vector<std::pair<std::size_t, std::size_t>>{{1, 2}}));
  EXPECT_EQ(c.follows, 0u) << "it does not matter between those that are farther";
}

// Scores that differ by the same number every time: p is 0, and only the size of the difference decides.
TEST(Conclusion, NeedsADifferenceOfATenth) {
  EXPECT_EQ(kLeastDifference, 0.1);
  for (const double by : {0.125, 0.0625}) {
    PersonScores one{{}, {levels({0, by, 1, 2}, 20, 0)}};
    EXPECT_EQ(concludePerson(one, kCandidates, kReference).decided(), by > 0.1) << by;
    EXPECT_EQ(concludePerson(one, kCandidates, kReference).notToldApart.empty(), by > 0.1) << by;
  }
}

TEST(Conclusion, OfACandidateThatFitsWorseThanThePersonsOwnMeanIsPoor) {
  for (const double above : {0.04, 0.2}) {
    PersonScores one{{}, {levels({-3, 0, 0, 0})}};
    for (const double y : one.conditions[0].score[0]) one.conditions[0].own.push_back(y - above + 0.01 * (y > -3 ? 1 : -1));
    const Obstacle expected = above > kLeastMisfit ? Obstacle::Poor : Obstacle::None;
    const Conclusion alone = concludePerson(one, kCandidates, kReference);
    EXPECT_EQ(alone.reason, expected) << above;
    EXPECT_NEAR(alone.misfit.mean, above, 0.01);
    std::vector<PersonScores> five(5, one);
    for (std::size_t i = 0; i < five.size(); ++i)
      for (double& y : five[i].conditions[0].own) y += 0.001 * static_cast<double>(i);
    EXPECT_EQ(concludePeople(five, kCandidates, kReference).reason, expected) << above;
  }
}

// Shares of 2.5 and 2.2 standard deviations: p = 0.006 and 0.014, normally distributed. People's shares are averaged.
TEST(Conclusion, OfACandidateWithSystematicResidualsIsPoor) {
  for (const double deviations : {2.5, 2.2}) {
    PersonScores one{{}, {levels({-3, 0, 0, 0})}};
    one.conditions[0].systematic.assign(kCandidates, {0.1 * deviations, 0.01, 0});
    const Obstacle expected = deviations > 2.3 ? Obstacle::Poor : Obstacle::None;
    EXPECT_EQ(concludePerson(one, kCandidates, kReference).reason, expected) << deviations;
    for (SystematicRest& rest : one.conditions[0].systematic) rest.share /= std::sqrt(5.0);
    EXPECT_EQ(concludePerson(one, kCandidates, kReference).reason, Obstacle::None);
    const Conclusion five = concludePeople(std::vector<PersonScores>(5, one), kCandidates, kReference);
    EXPECT_EQ(five.reason, expected) << deviations;
    EXPECT_NEAR(five.systematic.share / std::sqrt(five.systematic.variance), deviations, 1e-9);
    one.conditions[0].systematic.assign(kCandidates, {0.049, 1e-6, 0});
    EXPECT_EQ(concludePerson(one, kCandidates, kReference).reason, Obstacle::None) << "a small part does not count";
    one.conditions[0].systematic.assign(kCandidates, {0.24, 1e-6, 0});
    for (const double r2 : {0.9998, 0.99999}) {  // 0.7 and 0.15 % of the speed
      one.conditions[0].r2[0] = one.conditions[0].ceiling = r2;
      EXPECT_EQ(concludePerson(one, kCandidates, kReference).reason, r2 < 0.9999 ? Obstacle::Poor : Obstacle::None) << r2;
    }
  }
}

// The way towards a candidate is one-sided: away from it is no sign of a mixture. Three others are tested.
TEST(Conclusion, OfMovementsThatGoTowardsAnotherCandidateIsPoor) {
  for (const double share : {0.3, -0.3}) {
    PersonScores one{{}, {levels({-3, 0, 0, 0}, 20)}};
    std::vector<double> way;
    for (int i = 0; i < 20; ++i) way.push_back(share + (i % 2 == 0 ? 0.2 : -0.2) + 0.01 * i);
    std::vector<std::vector<double>> none(kCandidates, std::vector<double>(20, 0.0));
    one.conditions[0].toward.assign(kCandidates, none);
    one.conditions[0].toward[0][2] = way;
    const Conclusion alone = concludePerson(one, kCandidates, kReference);
    EXPECT_EQ(alone.reason, share > 0 ? Obstacle::Poor : Obstacle::None);
    if (share < 0) continue;
    EXPECT_EQ(alone.mixedWith, 2u);
    EXPECT_NEAR(alone.mixture.mean, 0.395, 1e-12);
    EXPECT_NEAR(alone.mixtureP, 3 * computeSerialTTest(way).p / 2, 1e-15);
    std::vector<PersonScores> five(5, one);
    for (std::size_t i = 0; i < five.size(); ++i)
      for (double& x : five[i].conditions[0].toward[0][2]) x += 0.02 * static_cast<double>(i);
    EXPECT_EQ(concludePeople(five, kCandidates, kReference).reason, Obstacle::Poor);
    EXPECT_NEAR(concludePeople(five, kCandidates, kReference).mixture.mean, 0.435, 1e-12);
  }
}

TEST(Conclusion, OfACandidateThatLeavesMoreSquaresThanThePersonsOwnMeanIsPoor) {
  PersonScores one{{}, {levels({-3, 0, 0, 0})}};
  for (const double r2 : {0.93, 0.945}) {  // 1.4 and 1.1 times what the own mean leaves
    one.conditions[0].r2[0] = r2;
    const Obstacle expected = r2 < 0.935 ? Obstacle::Poor : Obstacle::None;
    EXPECT_EQ(concludePerson(one, kCandidates, kReference).reason, expected) << r2;
    EXPECT_EQ(concludePeople(std::vector<PersonScores>(5, one), kCandidates, kReference).reason, expected) << r2;
  }
}

// Candidate 1 is at the edge of the range of masses. A mass outside it could be as near as the best, unless it too is told from it.
TEST(Conclusion, IsNoneWhileAMassAtTheEdgeMightBeNearer) {
  PersonScores one{{}, {levels({-3, -1, 0, 0})}};
  ConditionScores& scores = one.conditions[0];
  scores.beyond.resize(kCandidates);
  const auto reasonOf = [&] { return concludePerson(one, kCandidates, kReference).reason; };
  EXPECT_EQ(reasonOf(), Obstacle::None);
  scores.beyond[1] = scores.score[1];
  for (double& y : scores.beyond[1]) y += 0.5;
  EXPECT_EQ(reasonOf(), Obstacle::None) << "heavier hands are farther away";
  for (double& y : scores.beyond[1]) y -= 2.5;
  EXPECT_EQ(reasonOf(), Obstacle::MassAtEdge) << "a heavier hand is as near";
  EXPECT_EQ(concludePerson(one, kCandidates, kReference).atEdge, std::vector<std::size_t>{1});
  EXPECT_EQ(concludePeople(std::vector<PersonScores>(5, one), kCandidates, kReference).reason, Obstacle::MassAtEdge);
  EXPECT_EQ(concludePerson(one, kCandidates, kReference, {{1, 0}}).reason, Obstacle::None) << "the best is its limit for a heavy hand";
  scores.beyond[1].clear();
  scores.beyond[0] = scores.score[0];
  EXPECT_EQ(reasonOf(), Obstacle::MassAtEdge) << "the best itself";
}

TEST(Conclusion, BetweenOneCandidateAndTheReferenceIsNone) {
  PersonScores one{{}, {levels({-3, 0})}};
  EXPECT_EQ(concludePerson(one, 2, 1).reason, Obstacle::NothingToCompare);
  EXPECT_EQ(concludePeople(std::vector<PersonScores>(6, one), 2, 1).reason, Obstacle::NothingToCompare);
  one.conditions = {levels({-3, 0, 1})};
  EXPECT_EQ(concludePerson(one, 3, 2).reason, Obstacle::None);
  EXPECT_EQ(concludePeople(std::vector<PersonScores>(6, one), 3, 2).reason, Obstacle::None);
}

TEST(Conclusion, OfPeopleIsOverTheirMeansAndCountsThemAlike) {
  std::vector<PersonScores> all(5);
  for (std::size_t i = 0; i < 5; ++i) {
    const double own = 0.1 * static_cast<double>(i);
    all[i].conditions = {levels({-3 + own, -1, -2, own}, 10 + 3 * i), levels({-2, 0 + own, -1, 1}, 10)};
    all[i].conditions[0].r2[0] = 0.9 + 0.01 * static_cast<double>(i);
    all[i].conditions[1].r2[0] = 0.96;
    all[i].conditions[0].ceiling = 0.93, all[i].conditions[1].ceiling = 0.96 + 0.001 * static_cast<double>(i);
  }
  const Conclusion c = concludePeople(all, kCandidates, kReference);
  EXPECT_EQ(c.follows, 0u) << nameOf(c.reason);
  EXPECT_EQ(c.subjects, 5u);
  EXPECT_EQ(c.trials, 80u + 50u);
  EXPECT_EQ(c.level, 0.05);
  EXPECT_NEAR(c.r2, (0.92 + 0.96) / 2, 1e-12);
  EXPECT_NEAR(c.ceiling, (0.93 + 0.962) / 2, 1e-12);
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<double> apart;
    double score = 0;
    for (const PersonScores& p : all) {
      const auto own = [&](std::size_t of) { return (mean(p.conditions[0].score[of]) + mean(p.conditions[1].score[of])) / 2; };
      apart.push_back(own(k) - own(0));
      score += own(k) / 5;
    }
    EXPECT_NEAR(c.score[k], score, 1e-12) << k;
    if (k == 0) continue;
    EXPECT_NEAR(c.against[k].mean, mean(apart), 1e-12) << k;
    EXPECT_NEAR(c.against[k].p, computeTTest(apart).p, 1e-9) << k;
  }
}

// One person's trials are worth so many samples: their evidence is half of those times the scores.
TEST(Conclusion, WeighsEvidenceByTheSamplesThatATrialIsWorth) {
  const auto posteriorWith = [](double samples) {
    std::vector<PersonScores> all(5);
    for (PersonScores& p : all) {
      p.conditions = {levels({0, 0.02, 1, 2}, 10, 0)};
      p.conditions[0].effectiveSamples = samples;
    }
    return concludePeople(all, kCandidates, kReference).posterior;
  };
  std::vector<double> evidence{0, -0.02 * 10 * 8 / 2, -400, -800};
  const std::vector<double> expected = selectModel(std::vector<std::vector<double>>(5, evidence)).protectedExceedance;
  const std::vector<double> given = posteriorWith(8);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(given[k], expected[k], 1e-6) << k;
  EXPECT_GT(posteriorWith(80)[0], given[0]);
}

TEST(Conclusion, CountsThePeopleWhomEachCandidateIsClosestTo) {
  std::vector<PersonScores> all(5);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].conditions = {i < 3 ? levels({-5, -1, 0, 0}) : levels({-1, -2, 0, 0})};
  EXPECT_EQ(concludePeople(all, kCandidates, kReference).closest, (std::vector<std::size_t>{3, 2, 0, 0}));
  EXPECT_EQ(concludePerson(all[4], kCandidates, kReference).closest, (std::vector<std::size_t>{0, 1, 0, 0}));
}

TEST(Conclusion, OfPeopleDecidedForOtherThanTheBestIsNone) {
  std::vector<PersonScores> all;
  for (int i = 0; i < 6; ++i) {
    all.emplace_back();
    all.back().conditions = {i < 5 ? levels({-5, -1, 0, 0}) : levels({-1.3, -3, 0, 0})};
  }
  const Conclusion c = concludePeople(all, kCandidates, kReference);
  EXPECT_EQ(c.best, 0u);
  EXPECT_EQ(c.reason, Obstacle::SubjectsDiffer);
  EXPECT_EQ(c.each[0], 0u);
  EXPECT_EQ(c.each[5], 1u);
}

TEST(Conclusion, LeavesOutPeopleWithoutConditions) {
  std::vector<PersonScores> all = people(5, 2, 0.8);
  all.insert(all.begin() + 2, PersonScores{"without", {}});
  const Conclusion c = concludePeople(all, kCandidates, kReference);
  EXPECT_EQ(c.subjects, 5u);
  EXPECT_EQ(c.each.size(), 5u);
  EXPECT_EQ(c.follows, 2u);
  EXPECT_EQ(concludePeople({PersonScores{}, all[0]}, kCandidates, kReference).subjects, 1u);
}

}  // namespace
}  // namespace reachlab::analysis
