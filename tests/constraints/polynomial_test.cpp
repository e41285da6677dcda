#include "constraints/formula/polynomial.h"

#include <gtest/gtest.h>

#include "constraints/formula/parser.h"

namespace reachlab::constraints {
namespace {

constexpr double kShape[] = {0.7, -1.3};

int nodeOf(ExpressionGraph& graph, const std::string& text) { return parseFormula(text, {{"u", "v"}, {"a", "b"}}, graph).root; }
std::optional<Polynomial> polynomialOf(const std::string& text) {
  ExpressionGraph graph;
  const int root = nodeOf(graph, text);
  return Polynomial::of(graph, root, kShape);
}
double largestOf(const std::string& text) {
  const auto polynomial = polynomialOf(text);
  EXPECT_TRUE(polynomial) << text;
  return polynomial ? polynomial->largest() : -1;
}

TEST(Polynomial, VanishesWhereItsTermsDo) {
  for (const char* nothing :
       {"0", "(u + v)^2 - u^2 - 2*u*v - v^2", "(u - v)*(u + v) - (u^2 - v^2)", "(u + 2)^3 - (u^3 + 6*u^2 + 12*u + 8)",
        "(u + v)/4 - 0.25*u - v/4", "a*u - 0.7*u", "(sin(u)^2 + 1)*v - (2 - cos(u)^2)*v", "sin(u)^4 - (1 - cos(u)^2)^2",
        "cosh(u)^2 - (1 + sinh(u)^2)", "sinh(u)^2*v - (cosh(u)^2 - 1)*v", "sqrt(u + 1)^3 - sqrt(u + 1)*(u + 1)", "abs(u)^2*v - u^2*v",
        "abs(u)^3 - u^2*abs(u)", "-(u + v) + u + v", "u*sqrt(1 - u^2)^2 - u + u^3"})
    EXPECT_LT(largestOf(nothing), 1e-14) << nothing;
}

TEST(Polynomial, HasTheLargestOfItsCoefficients) {
  EXPECT_EQ(largestOf("3*u - 5*v + 2"), 5);
  EXPECT_EQ(largestOf("(2*u + 3*v)^2"), 12);
  EXPECT_EQ(largestOf("(u + v)*(u - v)"), 1);
  EXPECT_EQ(largestOf("u/4 + v/8"), 0.25);
  EXPECT_EQ(largestOf("u/b"), 1 / 1.3);
  EXPECT_EQ(largestOf("-7"), 7);
  EXPECT_EQ(largestOf("2*sin(u)*cos(u)"), 2);
  EXPECT_EQ(largestOf("(1 + u)/(1 + v)"), 1) << "a quotient is an indeterminate of its own";
  EXPECT_EQ(largestOf("sin(u)^2 + cos(v)^2"), 1);
  EXPECT_EQ(largestOf("u/b + v/b*2"), 2 / 1.3);
}

TEST(Polynomial, SignsOfADivisorCount) {
  EXPECT_LT(largestOf("(u + 1)/b + u/1.3 + 1/1.3"), 1e-15) << "b is -1.3";
  EXPECT_LT(largestOf("(u + 1)/a - u/0.7 - 1/0.7"), 1e-15);
}

TEST(Polynomial, AddsAndScales) {
  Polynomial sum = Polynomial::constant(3);
  sum += Polynomial::constant(-7);
  EXPECT_EQ(sum.largest(), 4);
  sum *= -2.5;
  EXPECT_EQ(sum.largest(), 10);
  EXPECT_EQ(Polynomial::constant(0).largest(), 0);
}

TEST(Polynomial, IsNoneWhereItHasTooManyTerms) {
  std::string sum = "1";
  for (int k = 1; k <= 64; ++k) sum += "+sin(" + std::to_string(k) + "*u)";
  EXPECT_FALSE(polynomialOf("(" + sum + ")*(v + " + sum + ")")) << "65 times 66 terms";
  EXPECT_TRUE(polynomialOf("(" + sum + ")*(u + v)"));
  EXPECT_FALSE(polynomialOf("u + (" + sum + ")*(v + " + sum + ")"));
  EXPECT_FALSE(polynomialOf("-((" + sum + ")*(v + " + sum + "))"));
}

}  // namespace
}  // namespace reachlab::constraints
