#include "analysis/conclusions/progress_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/conclusions/comparison.h"

namespace reachlab::analysis {
namespace {

void attempts(std::vector<Attempt>& to, const std::string& subject, const std::string& session, int day, std::size_t condition,
              int successes, int trials) {
  for (int i = 0; i < trials; ++i) to.push_back({subject, session, day, condition, i < successes});
}

double logit(double s, double n) { return std::log((s + 0.5) / (n - s + 0.5)); }

/// Three people, two days, two conditions; the third does not do the second condition on the second day.
std::vector<SuccessCell> cells() {
  std::vector<Attempt> all;
  attempts(all, "a", "1", 1, 0, 4, 20);
  attempts(all, "a", "2", 2, 0, 9, 18);
  attempts(all, "b", "1", 1, 0, 0, 10);
  attempts(all, "b", "2", 2, 0, 10, 10);
  attempts(all, "c", "1", 1, 0, 6, 12);
  attempts(all, "c", "2", 2, 0, 3, 16);
  attempts(all, "a", "1", 1, 1, 5, 25);
  attempts(all, "a", "2", 2, 1, 11, 20);
  attempts(all, "b", "1", 1, 1, 2, 8);
  attempts(all, "c", "1", 1, 1, 9, 15);
  return successTable(all);
}

double unweightedMean(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

TEST(TypicalShare, IsTheMeanLogitOfPeopleBackAsAShare) {
  const std::vector<SuccessCell> all = cells();
  const auto back = [](double l) { return 1 / (1 + std::exp(-l)); };
  const std::vector<double> day{logit(4, 20), logit(0, 10), logit(6, 12)}, both{logit(13, 38), logit(10, 20), logit(9, 28)};
  std::vector<double> variance;
  for (const auto& [s, n] : {std::pair{13.0, 38.0}, {10.0, 20.0}, {9.0, 28.0}}) variance.push_back(1 / (s + 0.5) + 1 / (n - s + 0.5));
  EXPECT_NEAR(typicalShare(all, 0, 1)->mean, back(unweightedMean(day)), 1e-12);
  EXPECT_EQ(typicalShare(all, 0, 1)->people, 3u);
  const auto share = typicalShare(all, 0);
  const PeopleMean expected = computePeopleMean(both, variance);
  EXPECT_NEAR(share->mean, back(unweightedMean(both)), 1e-12);
  EXPECT_NEAR(share->interval.low, back(expected.interval.low), 1e-12);
  EXPECT_NEAR(share->interval.high, back(expected.interval.high), 1e-12);
  EXPECT_FALSE(typicalShare(all, 1, 2)) << "one person has no typical one beside";
  EXPECT_FALSE(typicalShare(all, 7));
}

/// A share's variance by the same rule, half a success and half a failure added. [1]
double varianceOf(double s, double n) {
  const double p = (s + 0.5) / (n + 1);
  return p * (1 - p) / n;
}

TEST(Effects, OfDaysArePairedOverPeople) {
  const std::vector<Effect> effects = effectsOf(cells(), 2);
  ASSERT_EQ(effects.size(), 3u);
  const Effect& first = effects[0];
  EXPECT_TRUE(first.ofDay);
  EXPECT_EQ(first.condition, 0u);
  EXPECT_EQ(first.from, 1);
  EXPECT_EQ(first.to, 2);
  EXPECT_EQ(first.people, 3u);
  EXPECT_EQ(effects[1].condition, 1u);
  EXPECT_EQ(effects[1].people, 1u) << "one did it on both days";
  EXPECT_EQ(first.p, std::min(1.0, 2 * first.logit.p)) << "two effects of days are corrected together";
  EXPECT_EQ(effects[1].p, 1);
}

TEST(Effects, OfDaysAreBetweenTheDaysOfTheCondition) {
  std::vector<Attempt> all;
  for (const int day : {1, 2, 3}) attempts(all, "a", std::to_string(day), day, 0, 5, 10);
  for (const int day : {1, 3}) attempts(all, "a", std::to_string(day), day, 1, 2 * day, 10);
  const std::vector<Effect> effects = effectsOf(successTable(all), 2);
  const auto of = std::find_if(effects.begin(), effects.end(), [](const Effect& e) { return e.ofDay && e.condition == 1; });
  ASSERT_NE(of, effects.end()) << "nobody did it on day 2";
  EXPECT_EQ(of->from, 1);
  EXPECT_EQ(of->to, 3);
  EXPECT_NEAR(of->points.mean, 40, 1e-9);
}

// A person's effect is the mean over the days on which both were done, and as sure as the mean of those.
TEST(Effects, OfConditionsAreMeansOverCommonDays) {
  const Effect pace = effectsOf(cells(), 2)[2];
  EXPECT_FALSE(pace.ofDay);
  EXPECT_EQ(pace.from, 0);
  EXPECT_EQ(pace.to, 1);
  EXPECT_EQ(pace.people, 3u);
  const std::vector<double> points{100 * ((5.0 / 25 - 4.0 / 20) + (11.0 / 20 - 9.0 / 18)) / 2, 100 * (2.0 / 8),
                                   100 * (9.0 / 15 - 6.0 / 12)};
  const std::vector<double> variance{1e4 * (varianceOf(5, 25) + varianceOf(4, 20) + varianceOf(11, 20) + varianceOf(9, 18)) / 4,
                                     1e4 * (varianceOf(2, 8) + varianceOf(0, 10)), 1e4 * (varianceOf(9, 15) + varianceOf(6, 12))};
  const PeopleMean expected = computePeopleMean(points, variance);
  EXPECT_NEAR(pace.points.mean, unweightedMean(points), 1e-9);
  EXPECT_NEAR(pace.pointsInterval.low, expected.interval.low, 1e-9);
  EXPECT_NEAR(pace.pointsInterval.high, expected.interval.high, 1e-9);
  const double own = (logit(5, 25) - logit(4, 20) + logit(11, 20) - logit(9, 18)) / 2;
  EXPECT_NEAR(pace.logit.mean, unweightedMean({own, logit(2, 8) - logit(0, 10), logit(9, 15) - logit(6, 12)}), 1e-12);
  EXPECT_EQ(pace.p, pace.logit.p) << "the only one of its kind";
  EXPECT_TRUE(effectsOf({}, 3).empty());
}

// Successes in the last 3, or 2, of 6: by hand, sum x y = 0.5 + 1.5 + 2.5, or 1.5 + 2.5, and sum x^2 = 17.5.
TEST(LearningSlopes, AreLeastSquaresInPointsPerHundredTrials) {
  std::vector<Attempt> all;
  for (const char* subject : {"a", "b"})
    for (int i = 0; i < 6; ++i) all.push_back({subject, "1", 1, 1, subject[0] == 'a' ? i >= 3 : i >= 4});
  all.push_back({"short", "1", 1, 1, true});
  all.push_back({"short", "1", 1, 1, true});
  const std::vector<LearningSlope> slopes = learningSlopes(all, 2);
  ASSERT_EQ(slopes.size(), 1u) << "nobody did the first condition";
  EXPECT_EQ(slopes[0].condition, 1u);
  EXPECT_EQ(slopes[0].people, 2u) << "two trials have no slope";
  EXPECT_NEAR(slopes[0].perHundred, 1e4 * (4.5 + 4) / 2 / 17.5, 1e-9);
  all.resize(3);
  EXPECT_EQ(learningSlopes(all, 2).at(0).people, 1u) << "three trials have one";
}

// People who succeed in 3, 5 and 12 of 20 trials of three conditions, and up to two more each.
TEST(Effects, OfConditionsAreCorrectedTogetherByHolm) {
  std::vector<Attempt> all;
  for (std::size_t condition = 0; condition < 3; ++condition)
    for (int person = 0; person < 5; ++person)
      attempts(all, std::string(1, static_cast<char>('a' + person)), "1", 1, condition, std::array{3, 5, 12}[condition] + person % 3, 20);
  std::vector<double> own, told;
  for (const Effect& effect : effectsOf(successTable(all), 3))
    if (!effect.ofDay) own.push_back(effect.logit.p), told.push_back(effect.p);
  ASSERT_EQ(own.size(), 3u);
  EXPECT_EQ(told, adjustByHolm(own));
  const auto least = static_cast<std::size_t>(std::min_element(own.begin(), own.end()) - own.begin());
  EXPECT_LT(own[least], 0.3);
  EXPECT_DOUBLE_EQ(told[least], 3 * own[least]) << "the smallest of three counts thrice";
}

}  // namespace
}  // namespace reachlab::analysis
