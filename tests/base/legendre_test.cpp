#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/math/gauss_legendre.h"
#include "base/math/legendre_series.h"

namespace reachlab {
namespace {

// The rules with closed forms (Abramowitz and Stegun 25.4.30).
TEST(GaussRule, HasTheNodesAndWeightsOfItsClosedForms) {
  EXPECT_EQ(makeGaussRule(1).node, std::vector<double>{0});
  EXPECT_EQ(makeGaussRule(1).weight, std::vector<double>{2});
  const GaussRule two = makeGaussRule(2), three = makeGaussRule(3);
  EXPECT_EQ(two.node, (std::vector<double>{-std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)}));
  EXPECT_EQ(two.weight, (std::vector<double>{1, 1}));
  EXPECT_NEAR(three.node[0], -std::sqrt(0.6), 2e-16);
  EXPECT_EQ(three.node[1], 0);
  EXPECT_NEAR(three.node[2], std::sqrt(0.6), 2e-16);
  EXPECT_NEAR(three.weight[0], 5.0 / 9, 2e-16);
  EXPECT_NEAR(three.weight[1], 8.0 / 9, 2e-16);
  EXPECT_EQ(three.weight[2], three.weight[0]);
}

TEST(GaussRule, IsExactToItsDegreeAndNoFurther) {
  for (const int count : {1, 2, 5, 16, 33}) {
    const GaussRule rule = makeGaussRule(count);
    ASSERT_EQ(rule.node.size(), static_cast<std::size_t>(count));
    EXPECT_TRUE(std::is_sorted(rule.node.begin(), rule.node.end()));
    const auto integral = [&](int degree) {
      double sum = 0;
      for (std::size_t i = 0; i < rule.node.size(); ++i) sum += rule.weight[i] * std::pow(rule.node[i], degree);
      return sum;
    };
    for (int degree = 0; degree < 2 * count; ++degree)
      EXPECT_NEAR(integral(degree), degree % 2 == 0 ? 2.0 / (degree + 1) : 0, 3e-16 * (count + 3)) << count << ", " << degree;
    if (count < 10) {
      EXPECT_LT(integral(2 * count), 2.0 / (2 * count + 1) - 1e-4) << count;
    }
  }
  EXPECT_EQ(gaussRule16().node, makeGaussRule(16).node);
  EXPECT_EQ(gaussRule16().weight, makeGaussRule(16).weight);
}

const std::vector<std::vector<double>> kLegendre{// P_n by powers of x
                                                 {1},
                                                 {0, 1},
                                                 {-0.5, 0, 1.5},
                                                 {0, -1.5, 0, 2.5},
                                                 {0.375, 0, -3.75, 0, 4.375}};
double polynomialAt(const std::vector<double>& powers, double x) {
  return std::accumulate(powers.rbegin(), powers.rend(), 0.0, [x](double sum, double c) { return sum * x + c; });
}

TEST(LegendreSeries, IsTheSumOfItsPolynomials) {
  const LegendreSeries series{0.5, -2, 3, 0.25, -1.5};
  for (const double x : {-1.0, -0.7, 0.0, 0.3, 1.0}) {
    const std::vector<double> values = legendreValues(5, x);
    ASSERT_EQ(values.size(), 5u);
    double sum = 0;
    for (std::size_t n = 0; n < 5; ++n) {
      EXPECT_NEAR(values[n], polynomialAt(kLegendre[n], x), 1e-15) << n;
      sum += series[n] * polynomialAt(kLegendre[n], x);
    }
    EXPECT_NEAR(valueAt(series, x), sum, 2e-15);
  }
  EXPECT_EQ(valueAt({}, 0.3), 0);
  EXPECT_TRUE(legendreValues(0, 0.3).empty());
}

TEST(LegendreSeries, ItsIntegralRisesFromMinusOne) {
  const LegendreSeries series{0.5, -2, 3, 0.25, -1.5}, integral = integralOf(series);
  ASSERT_EQ(integral.size(), 6u);
  for (const double x : {-1.0, -0.7, 0.0, 0.3, 1.0}) {
    double sum = 0;
    for (std::size_t n = 0; n < 5; ++n) {
      std::vector<double> powers{0};
      for (std::size_t k = 0; k < kLegendre[n].size(); ++k) powers.push_back(kLegendre[n][k] / static_cast<double>(k + 1));
      sum += series[n] * (polynomialAt(powers, x) - polynomialAt(powers, -1));
    }
    EXPECT_NEAR(valueAt(integral, x), sum, 3e-15) << x;
  }
}

TEST(LegendreSeries, IsFoundThroughTheValuesAtTheNodes) {
  const LegendreSeries series{0.5, -2, 3, 0.25, -1.5};
  const GaussRule rule = makeGaussRule(5);
  std::vector<double> values;
  for (const double x : rule.node) values.push_back(valueAt(series, x));
  const LegendreSeries found = projectOnLegendre(values, rule.node, rule.weight);
  ASSERT_EQ(found.size(), 5u);
  for (std::size_t n = 0; n < 5; ++n) EXPECT_NEAR(found[n], series[n], 3e-15) << n;
}

}  // namespace
}  // namespace reachlab
