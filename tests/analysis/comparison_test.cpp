#include "analysis/conclusions/comparison.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "analysis/conclusions/model_selection.h"

namespace reachlab::analysis {
namespace {

// Student's own data (1908): the extra sleep of ten patients, the second drug less the first.
const std::vector<double> kSleep{1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};

TEST(SignFlip, CountsEveryExchangeOfSigns) {
  std::vector<double> many;
  for (int i = 0; i < 21; ++i) many.push_back(0.1 * i - 0.5);
  const std::pair<std::vector<double>, double> cases[] = {{{}, 1},
                                                          {{5}, 1},  // either sign is as far
                                                          {{1, -1}, 1},
                                                          {{1, 2, 3, 4, 5, 6}, 2.0 / 64},
                                                          {{-1, 2, 3}, 4.0 / 8},  // |sums| of ±1 ±2 ±3: 4 or more in 4 of 8
                                                          {std::vector<double>(20, 1.0), 2 / std::pow(2.0, 20)},
                                                          {many, computeTTest(many).p}};  // 2^21 are not tried
  for (const auto& [values, p] : cases) EXPECT_DOUBLE_EQ(computeSignFlipP(values), p) << values.size();
}

TEST(Holm, IsMonotoneKeepsTheOrderOfEqualOnesAndNeverExceedsOne) {
  const std::pair<std::vector<double>, std::vector<double>> cases[] = {
      {{0.01, 0.04, 0.03, 0.005}, {0.03, 0.06, 0.06, 0.02}}, {{0.25, 0.25, 0.125}, {0.5, 0.5, 0.375}}, {{0.6, 0.7}, {1, 1}}, {{}, {}}};
  for (const auto& [p, expected] : cases) {
    const std::vector<double> adjusted = adjustByHolm(p);
    ASSERT_EQ(adjusted.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(adjusted[i], expected[i]) << p[i];
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

// The last number and n = 5 by hand: mean 2, sum of squares 40, error sqrt(10 / 5).
TEST(TTest, IsWorkedOutByHand) {
  const TTest t = computeTTest(std::vector<double>{-2, 0, 2, 4, 6});
  EXPECT_DOUBLE_EQ(t.mean, 2);
  EXPECT_DOUBLE_EQ(t.error, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(t.t, std::sqrt(2.0));
  EXPECT_EQ(t.freedom, 4);
  // Four degrees of freedom have a closed form: p = 1 - a (3 - a^2) / 2 with a = t / sqrt(t^2 + 4).
  const double a = std::sqrt(2.0 / 6);
  EXPECT_NEAR(t.p, 1 - a * (3 - a * a) / 2, 1e-12);
  EXPECT_NEAR(computeTTest(std::vector<double>{2, 0, -2, -4, -6}).p, t.p, 1e-15) << "two-sided";
}

TEST(TTest, OfTheSameNumberEveryTimeIsSureUnlessItIsNothing) {
  const TTest same = computeTTest(std::vector<double>(4, -2.5)), none = computeTTest(std::vector<double>(4, 0.0));
  EXPECT_EQ(same.p, 0);
  EXPECT_EQ(same.t, -INFINITY);
  EXPECT_EQ(computeTTest(std::vector<double>(4, 2.5)).t, INFINITY);
  EXPECT_EQ(none.p, 1);
  EXPECT_EQ(none.t, 0);
}

TEST(TTest, OfNothingOrOneJudgesNothing) {
  const TTest none = computeTTest({}), one = computeTTest(std::vector<double>{3.0});
  EXPECT_TRUE(none.mean == 0 && none.error == 0 && none.t == 0 && none.freedom == 0 && none.p == 1);
  EXPECT_TRUE(one.mean == 3 && one.error == 0 && one.t == 0 && one.freedom == 0 && one.p == 1);
  EXPECT_EQ(computeTTest(std::vector<double>{1, std::nan("")}).p, 1) << "what is not a number judges nothing";
  EXPECT_EQ(computeMeanInterval(std::vector<double>{3.0}).low, -INFINITY);
  EXPECT_EQ(computePeopleMean(std::vector<double>{3.0}, std::vector<double>{1.0}).test.p, 1);
}

// Two values have one degree of freedom: the quantile is tan(pi level / 2).
TEST(MeanInterval, OfTwoValuesIsCauchys) {
  for (const double level : {0.5, 0.9, 0.95}) {
    const Bounds i = computeMeanInterval(std::vector<double>{1, 4}, level);
    const double half = std::tan(3.14159265358979324 * level / 2) * 1.5;
    EXPECT_NEAR(i.low, 2.5 - half, 1e-9);
    EXPECT_NEAR(i.high, 2.5 + half, 1e-9);
  }
  EXPECT_EQ(computeMeanInterval(kSleep).low, computeMeanInterval(kSleep, 0.95).low);
}

TEST(PeopleMean, OfPeopleWhoAgreeIsAsSureAsTheirOwnTrials) {
  const PeopleMean agree = computePeopleMean(std::vector<double>{2, 2, 2, 2}, std::vector<double>{1, 2, 3, 10}, 0.9);
  EXPECT_NEAR(agree.test.p, std::erfc(2.0 / std::sqrt(2.0)), 1e-12) << "the mean's own error is 4 / 4";
  EXPECT_NEAR(agree.interval.low, 2 - 1.6448536269514722, 1e-9);
  EXPECT_NEAR(agree.interval.high, 2 + 1.6448536269514722, 1e-9);
  const PeopleMean below = computePeopleMean(std::vector<double>{-2, -2, -2, -2}, std::vector<double>{1, 2, 3, 10}, 0.9);
  EXPECT_NEAR(below.test.p, agree.test.p, 1e-15);
  EXPECT_EQ(computePeopleMean(std::vector<double>{2, 2}, std::vector<double>{0, 0}).test.p, 0);
  EXPECT_NEAR(computePeopleMean(kSleep, std::vector<double>(10, 0.0)).interval.high, 2.4598858, 5e-7) << "95 % unless told otherwise";
}

TEST(SerialTTest, OfFewerThanThreeTakesThemForIndependent) {
  EXPECT_EQ(computeSerialCorrelation(std::vector<double>{1, 2}), 0);
  EXPECT_EQ(computeSerialTTest(std::vector<double>{1, 2}).p, computeTTest(std::vector<double>{1, 2}).p);
  EXPECT_EQ(computeSerialTTest(std::vector<double>{4}).mean, 4);
  EXPECT_EQ(computeSerialCorrelation(std::vector<double>(5, 3.0)), 0) << "without scatter there is none";
}

// 20 times 0.1249 has a sum whose 20th part is not 0.1249.
TEST(SerialTTest, TheSameNumberEveryTimeIsAsSureAsItCanBe) {
  for (const double same : {0.1249, 0.125, -1e-9}) {
    const std::vector<double> values(20, same);
    for (const TTest& test : {computeTTest(values), computeSerialTTest(values)}) {
      EXPECT_EQ(test.mean, same);
      EXPECT_EQ(test.p, 0) << same;
      EXPECT_EQ(test.freedom, 19) << same;
    }
    EXPECT_EQ(computeSerialCorrelation(values), 0) << same;
  }
}

// 1 2 4: differences to the mean of 7/3 are -4/3, -1/3, 5/3; (4 - 5) / 9 is below 0, and of 1 2 3 4 5 it is (2 + 0 + 0 + 2) / 10.
TEST(SerialTTest, IsWorkedOutByHand) {
  EXPECT_EQ(computeSerialCorrelation(std::vector<double>{1, 2, 4}), 0);
  const std::vector<double> rising{1, 2, 3, 4, 5};
  EXPECT_NEAR(computeSerialCorrelation(rising), 0.4, 1e-12);
  const TTest t = computeSerialTTest(rising);
  const double effective = 5 * 0.6 / 1.4;
  EXPECT_NEAR(t.freedom, effective - 1, 1e-12);
  EXPECT_NEAR(t.error, std::sqrt(2.5 / effective), 1e-12);
  EXPECT_NEAR(t.t, 3 / t.error, 1e-12);
}

TEST(CombineTTests, OfUnequalConditionsIsWelchsAndSatterthwaites) {
  const TTest a{3, 0.5, 6, 9, 0.01}, b{-1, 0.25, -4, 4, 0.02};
  const TTest both = combineTTests(std::vector<TTest>{a, b});
  EXPECT_DOUBLE_EQ(both.mean, 1);
  EXPECT_NEAR(both.error, std::sqrt(0.25 + 0.0625) / 2, 1e-15);
  EXPECT_NEAR(both.freedom, 0.3125 * 0.3125 / (0.0625 / 9 + 0.00390625 / 4), 1e-9);
  EXPECT_NEAR(both.t, 1 / both.error, 1e-9);
  EXPECT_GT(both.p, 0);
  EXPECT_LT(both.p, 0.01);
}

TEST(CombineTTests, OfOneIsItselfAndOfOneThatIsNotJudgedIsNone) {
  const TTest a{3, 0.5, 6, 9, 0.01}, one{5, 0, 0, 0, 1};
  EXPECT_EQ(combineTTests(std::vector<TTest>{a}).p, 0.01);
  const TTest both = combineTTests(std::vector<TTest>{a, one});
  EXPECT_DOUBLE_EQ(both.mean, 4);
  EXPECT_EQ(both.p, 1);
  EXPECT_EQ(both.freedom, 0);
  EXPECT_EQ(combineTTests({}).p, 1);
  // Neither scatters: the mean is as sure as either.
  const TTest sure{2, 0, INFINITY, 3, 0};
  EXPECT_EQ(combineTTests(std::vector<TTest>{sure, sure}).p, 0);
  EXPECT_EQ(combineTTests(std::vector<TTest>{sure, sure}).freedom, 1);
}

// Three models, Dirichlet(1 + 4, 1 + 1, 1): exceedance by the sum over a fine grid of the simplex, the density being p^4 q.
TEST(ModelSelection, OfThreeModelsIsAnIntegralOverTheirFrequencies) {
  const std::vector<std::vector<double>> evidence{{0, -900, -900}, {5, -900, -900}, {0, -900, -900}, {-3, -900, -900}, {-900, 0, -900}};
  const ModelSelection s = selectModel(evidence);
  constexpr int kParts = 1200;
  std::array<double, 3> won{};
  double all = 0;
  for (int i = 0; i < kParts; ++i)
    for (int k = 0; i + k < kParts; ++k) {
      const double p = (i + 1.0 / 3) / kParts, q = (k + 1.0 / 3) / kParts, r = 1 - p - q, density = p * p * p * p * q;
      won[p >= q && p >= r ? 0 : q >= r ? 1 : 2] += density;
      all += density;
    }
  EXPECT_NEAR(s.alpha[0], 5, 1e-9);
  EXPECT_NEAR(s.alpha[1], 2, 1e-9);
  EXPECT_NEAR(s.alpha[2], 1, 1e-9);
  for (std::size_t m = 0; m < 3; ++m) {
    EXPECT_NEAR(s.exceedance[m], won[m] / all, 2e-3) << m;
    EXPECT_NEAR(s.protectedExceedance[m], s.exceedance[m] * (1 - s.omnibusRisk) + s.omnibusRisk / 3, 1e-12);
  }
  EXPECT_NEAR(s.exceedance[0] + s.exceedance[1] + s.exceedance[2], 1, 1e-12);
}

// Where each person is sure of a model, the free energy is the evidence itself: ln of the Dirichlet-multinomial against equal frequencies.
TEST(ModelSelection, OfCertainPeopleHasTheRiskOfTheirCounts) {
  std::vector<std::vector<double>> evidence(3, {4, -700});
  evidence.push_back({-700, 2});
  const double differ = std::log(6.0 * 1 / 120), equal = 4 * std::log(0.5);  // B(4, 2) / B(1, 1) = 3! 1! / 5!
  EXPECT_NEAR(selectModel(evidence).omnibusRisk, 1 / (1 + std::exp(differ - equal)), 1e-9);
}

// Values by numerical integration with scipy.integrate.quad of the formula in Rouder et al. 2009, with r = sqrt(1/2).
TEST(BayesFactor, IsThatOfRouder) {
  const auto factor = [](double t, double n) { return computeBayesFactor(TTest{t, 1, t, n - 1, 0}); };
  EXPECT_NEAR(factor(0, 20), 0.232326294, 2e-7);
  EXPECT_NEAR(factor(2.24, 80), 1.29848565, 1e-6);
  EXPECT_NEAR(factor(2.03, 100), 0.790394150, 1e-6);
  EXPECT_NEAR(factor(4, 12), 21.5739584, 2e-5);
  EXPECT_NEAR(factor(1, 5), 0.576313649, 1e-6);
  EXPECT_EQ(computeBayesFactor(TTest{}), 1) << "nothing to judge by";
  EXPECT_EQ(computeBayesFactor(computeTTest(std::vector{0.5, 0.5, 0.5})), INFINITY) << "as sure as p = 0 of the same values";
}

TEST(MeanInterval, OfATestIsThatOfItsValues) {
  const std::vector<double> values{0.3, 0.1, 0.4, 0.2, 0.6};
  const Bounds one = intervalOf(computeTTest(values)), other = computeMeanInterval(values);
  EXPECT_DOUBLE_EQ(one.low, other.low);
  EXPECT_DOUBLE_EQ(one.high, other.high);
  EXPECT_FALSE(intervalOf(TTest{}).finite());
}

}  // namespace
}  // namespace reachlab::analysis
