#include "sim/analyze/conclusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace reachlab::analyze {
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

TEST(Conclusion, OfTwoToFourPeopleIsNeverDecided) {
  for (std::size_t n = 2; n <= 4; ++n) {
    const Conclusion c = concludePeople(people(n, 1, 5), kCandidates, kReference);
    EXPECT_FALSE(c.decided());
    EXPECT_EQ(c.reason, Obstacle::TooFewSubjects);
    EXPECT_TRUE(c.overSubjects);
    for (const auto& each : c.each) EXPECT_EQ(each, 1u);
  }
}

TEST(Conclusion, OfFivePeopleWhoAgreeIsDecided) {
  const Conclusion c = concludePeople(people(5, 2, 0.8), kCandidates, kReference);
  EXPECT_EQ(c.follows, 2u);
  EXPECT_LT(c.p, kSubjectsLevel);
  EXPECT_GE(c.posterior[2], kMinExceedance);
  EXPECT_FALSE(c.signFlipP);
  EXPECT_EQ(concludePeople(people(6, 2, 0.8), kCandidates, kReference).signFlipP, 2.0 / 64);
}

TEST(Conclusion, OfTwoCampsIsNeverDecided) {
  std::mt19937_64 random(3);
  std::vector<PersonScores> camps;
  for (int i = 0; i < 5; ++i) camps.push_back(person(random, i < 3 ? 0 : 1, 2));
  const Conclusion c = concludePeople(camps, kCandidates, kReference);
  EXPECT_FALSE(c.decided());
  EXPECT_EQ(c.reason, Obstacle::SubjectsDiffer);
}

TEST(Conclusion, ThatTheReferenceIsAsNearIsNone) {
  EXPECT_EQ(concludePeople(people(5, kReference, 1), kCandidates, kReference).reason, Obstacle::Reference);
  EXPECT_EQ(concludePeople(people(1, kReference, 1), kCandidates, kReference).reason, Obstacle::Reference);
  EXPECT_EQ(concludePeople(people(1, 0, 0.02), kCandidates, kReference).reason, Obstacle::Reference);
}

TEST(Conclusion, ThatDescribesBadlyIsNone) {
  std::vector<PersonScores> all = people(5, 0, 0.8);
  for (PersonScores& p : all) p.conditions[0].r2.assign(kCandidates, 0.8);
  EXPECT_EQ(concludePeople(all, kCandidates, kReference).reason, Obstacle::Poor);
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

}  // namespace
}  // namespace reachlab::analyze
