#include "analysis/steps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reachlab::analysis {
namespace {

AnalyzedTrial trialOf(const std::string& subject, std::vector<double> errors) {
  AnalyzedTrial trial;
  trial.key.subject = subject;
  trial.paperError = std::move(errors);
  return trial;
}

TEST(EpsilonTable, IsTheRootOfTheMeanOfSquaresLeastFirst) {
  std::vector<AnalyzedTrial> trials{trialOf("a", {3, 1, 9, 8}), trialOf("a", {4, 7, 1, 2}), trialOf("a", {100, 0, 0, 0})};
  trials[2].exclusion = "practice";
  trials.push_back(trialOf("a", {}));
  const EpsilonTable hand = makeEpsilonTable(trials, 2, false), object = makeEpsilonTable(trials, 2, true);
  ASSERT_EQ(hand.size(), 2u);
  EXPECT_EQ(hand[0].criterion, 0u);
  EXPECT_DOUBLE_EQ(hand[0].epsilon, std::sqrt(25.0 / 2));
  EXPECT_DOUBLE_EQ(hand[1].epsilon, 5);
  EXPECT_EQ(object[0].criterion, 1u);
  EXPECT_DOUBLE_EQ(object[0].epsilon, std::sqrt(68.0 / 2));
  EXPECT_DOUBLE_EQ(object[1].epsilon, std::sqrt(82.0 / 2));
  EXPECT_FALSE(hand[0].interval) << "one person has no interval";
  EXPECT_EQ(hand[0].difference, 0);
  EXPECT_DOUBLE_EQ(hand[1].difference, hand[1].epsilon - hand[0].epsilon);
  EXPECT_FALSE(hand[1].differenceInterval);
}

TEST(EpsilonTable, OfNoTrialIsEmpty) { EXPECT_TRUE(makeEpsilonTable({}, 3, false).empty()); }

TEST(EpsilonTable, SaysWhichAreApartFromTheFirst) {
  std::vector<AnalyzedTrial> trials;
  for (int i = 0; i < 4; ++i)
    trials.push_back(trialOf(std::string(1, static_cast<char>('a' + i)), {2 + 0.1 * i, 5 + 0.11 * i, 2.1 - 0.1 * i}));
  const EpsilonTable table = makeEpsilonTable(trials, 3, false);
  EXPECT_EQ(table[2].criterion, 1u);
  EXPECT_TRUE(table[2].apart);
  EXPECT_FALSE(table[1].apart);
  EXPECT_TRUE(table[0].interval);
  EXPECT_DOUBLE_EQ(table[2].mean, 5.165);
  EXPECT_GT(table[2].epsilon, table[2].mean) << "one counts squares over all, the other each person's own";
  EXPECT_FALSE(table[0].differenceInterval) << "not from itself";
}

TEST(EpsilonTable, HasAnIntervalAboutTheMeanOfPeopleAndNoneBelowZero) {
  const EpsilonTable table = makeEpsilonTable(std::vector{trialOf("a", {1, 1}), trialOf("b", {3, 3})}, 1, false);
  EXPECT_DOUBLE_EQ(table[0].mean, 2);
  EXPECT_EQ(table[0].interval->low, 0);
  EXPECT_NEAR(table[0].interval->high, 2 + 12.7062, 1e-3) << "t of one degree of freedom";
}

}  // namespace
}  // namespace reachlab::analysis
