#include "sim/analyze/comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/analyze/model_selection.h"

namespace reachlab::analyze {
namespace {

// Student's own data (1908): the extra sleep of ten patients, the second drug less the first; t = 4.0621, p = 0.002833 in every textbook.
const std::vector<double> kSleep{1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};

TEST(TTest, OfStudentsSleepIsTheTextbooks) {
  const TTest t = computeTTest(kSleep);
  EXPECT_NEAR(t.t, 4.0621, 5e-5);
  EXPECT_NEAR(t.p, 0.002833, 5e-7);
  const Interval i = computeMeanInterval(kSleep);
  EXPECT_NEAR(i.low, 0.7001142, 5e-7);
  EXPECT_NEAR(i.high, 2.4598858, 5e-7);
}

TEST(TTest, OfOneNumberSaysNothing) {
  EXPECT_EQ(computeTTest(std::vector<double>{3.0}).p, 1);
  EXPECT_TRUE(std::isinf(computeMeanInterval(std::vector<double>{3.0}).high));
}

// Two people are enough for their own scatter to count: no interval is narrower than what is known of either.
TEST(PeopleMean, IsNoBetterKnownThanThePeopleAre) {
  for (const std::vector<double>& values : {std::vector<double>{1, 3}, {1, 2, 3}, kSleep}) {
    const PeopleMean known = computePeopleMean(values, std::vector<double>(values.size(), 0.0));
    const PeopleMean scattered = computePeopleMean(values, std::vector<double>(values.size(), 400.0));
    EXPECT_EQ(known.test.p, computeTTest(values).p);
    EXPECT_LT(scattered.interval.low, known.interval.low) << values.size();
    EXPECT_GT(scattered.interval.high, known.interval.high) << values.size();
    const double half = 1.959963985 * 20 / std::sqrt(static_cast<double>(values.size()));
    EXPECT_NEAR(scattered.interval.high - scattered.interval.low, 2 * half, 1e-6);
    EXPECT_GT(scattered.test.p, known.test.p) << values.size();
  }
}

TEST(SerialTTest, CountsFewerTrialsWhenNeighboursAreAlike) {
  // 1, 1, 0, 0 … twenty times: rho = (sum of products of neighbours) / (sum of squares) = (+10 - 9) / 4 / (20 / 4) = 0.05.
  std::vector<double> v;
  for (int i = 0; i < 20; ++i) v.push_back(i / 2 % 2 == 0 ? 1 : 0);
  EXPECT_NEAR(computeSerialCorrelation(v), 0.05, 1e-12);
  const TTest t = computeSerialTTest(v);
  EXPECT_NEAR(t.freedom, 20 * 0.95 / 1.05 - 1, 1e-12);
  EXPECT_LT(t.t, computeTTest(v).t);
  // Neighbours that differ are not taken for more trials than there are.
  std::vector<double> opposite;
  for (int i = 0; i < 20; ++i) opposite.push_back(i % 2);
  EXPECT_EQ(computeSerialTTest(opposite).freedom, 19);
}

TEST(CombineTTests, OfTwoEqualConditionsHasWelchsFreedom) {
  const TTest one = computeTTest(kSleep);
  const TTest both = combineTTests(std::vector<TTest>{one, one});
  EXPECT_NEAR(both.freedom, 18, 1e-9);
  EXPECT_NEAR(both.error, one.error / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(both.t, one.t * std::sqrt(2.0), 1e-9);
}

TEST(SignFlip, CountsEveryExchangeOfSigns) {
  EXPECT_DOUBLE_EQ(computeSignFlipP(std::vector<double>{1, 2, 3, 4, 5, 6}), 2.0 / 64);
  EXPECT_DOUBLE_EQ(computeSignFlipP(std::vector<double>{1, -1}), 1);
  // 1 2 3 less 1: |sums| of at least 3 among ±1 ±1 ±2 …: by hand for -1 2 3: 4 or more in 4 of 8.
  EXPECT_DOUBLE_EQ(computeSignFlipP(std::vector<double>{-1, 2, 3}), 4.0 / 8);
}

TEST(Holm, IsMonotoneAndNoGentlerThanBonferroniForTheFirst) {
  const std::vector<double> p{0.01, 0.04, 0.03, 0.005};
  const std::vector<double> adjusted = adjustByHolm(p);
  EXPECT_DOUBLE_EQ(adjusted[3], 0.02);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.03);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[1], 0.06);
}

// Unanimous people, seven models: the protected exceedance that the rule's 0.85 and five people rest on.
TEST(ModelSelection, OfUnanimousPeopleGrowsWithTheirNumber) {
  const struct {
    std::size_t people;
    double exceedance;
  } cases[] = {{2, 0.43}, {3, 0.63}, {4, 0.80}, {5, 0.90}, {6, 0.95}, {8, 0.99}};
  for (const auto& c : cases) {
    std::vector<double> row(7, -50.0);
    row[2] = 0;
    const ModelSelection s = selectModel(std::vector<std::vector<double>>(c.people, row));
    EXPECT_NEAR(s.protectedExceedance[2], c.exceedance, 0.006) << c.people;
  }
}

TEST(ModelSelection, OfEqualEvidencePrefersNothing) {
  const ModelSelection s = selectModel(std::vector<std::vector<double>>(6, std::vector<double>(4, -3.0)));
  for (const double x : s.protectedExceedance) EXPECT_NEAR(x, 0.25, 1e-9);
  EXPECT_GT(s.omnibusRisk, 0.5);
}

// Two models: frequencies are Beta, and exceedance is its distribution function at one half. Beta(5, 2): 1 - I_{1/2}(5, 2) = 57/64.
TEST(ModelSelection, OfTwoModelsIsTheBetaDistribution) {
  const std::vector<std::vector<double>> evidence{{0, -800}, {0, -800}, {0, -800}, {0, -800}, {-800, 0}};
  const ModelSelection s = selectModel(evidence);
  EXPECT_NEAR(s.alpha[0], 5, 1e-9);
  EXPECT_NEAR(s.exceedance[0], 57.0 / 64, 1e-9);
}

}  // namespace
}  // namespace reachlab::analyze
