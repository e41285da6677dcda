#include "constraints/formula/parser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "constraints/formula/formula.h"
#include "tests/constraints/made_constraints.h"
#include "tests/refusal.h"

namespace reachlab::constraints {
namespace {

double value(const std::string& text, double phi = 0.7) {
  ExpressionGraph graph;
  const ParsedFormula parsed = parseFormula(text, {{"phi"}, {"a"}}, graph);
  EXPECT_FALSE(parsed.fault) << text << ": " << (parsed.fault ? parsed.fault->what : "");
  const double shape[] = {0.5};
  return parsed.fault ? NAN : evaluateNodes(graph, std::array{parsed.root}, shape, &phi)[0];
}

FormulaFault fault(const std::string& text) {
  ExpressionGraph graph;
  const ParsedFormula parsed = parseFormula(text, {{"phi"}, {"a", "length_m"}}, graph);
  EXPECT_TRUE(parsed.fault) << text << " was accepted";
  return parsed.fault.value_or(FormulaFault{});
}

TEST(Formula, PowersBindTighterThanSignsAndGroupToTheRight) {
  EXPECT_EQ(value("-2^2"), -4);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("2^-2"), 0.25);
  EXPECT_EQ(value("(-2)^2"), 4);
  EXPECT_EQ(value("8/4/2"), 1);
  EXPECT_EQ(value("8-4-2"), 2);
  EXPECT_EQ(value("2*-3"), -6);
  EXPECT_EQ(value("--+3"), 3);
}

TEST(Formula, EveryFunctionIsWhatItsNameSays) {
  const double x = 0.7, a = 0.5;
  EXPECT_NEAR(value("sin(phi) + cos(phi)*tan(phi)"), std::sin(x) + std::cos(x) * std::tan(x), kRounding);
  EXPECT_NEAR(value("asin(a) - acos(a) + atan(phi) + atan2(phi, -a)"), std::asin(a) - std::acos(a) + std::atan(x) + std::atan2(x, -a),
              4 * kRounding);
  EXPECT_NEAR(value("sinh(phi)*cosh(phi)/tanh(phi)"), std::sinh(x) * std::cosh(x) / std::tanh(x), 4 * kRounding);
  EXPECT_NEAR(value("exp(phi) + log(phi) + sqrt(phi) + abs(-phi) + sign(-phi)"), std::exp(x) + std::log(x) + std::sqrt(x) + x - 1,
              4 * kRounding);
  EXPECT_NEAR(value("phi^a + phi^2.5 + a^phi"), std::pow(x, a) + std::pow(x, 2.5) + std::pow(a, x), 4 * kRounding);
  EXPECT_EQ(value("pi"), std::numbers::pi);
  EXPECT_EQ(value("2.5e-1 + .5 + 1E2"), 100.75);
  EXPECT_EQ(value("e"), std::numbers::e);
}

TEST(Formula, FaultsPointAtTheCharacterAndSayWhatWasExpected) {
  const auto expect = [](const std::string& text, std::size_t character, const std::string& words) {
    const FormulaFault f = fault(text);
    EXPECT_EQ(f.character, character) << text;
    EXPECT_TRUE(holds(f.what, words)) << text;
  };
  expect("", 1, "expected a number, a name, a function or '('");
  expect("cos(phi", 8, "expected ')'");
  expect("2*phj", 3, "did you mean phi?");
  expect("zzz", 1, "unknown name 'zzz'; expected phi, a, length_m, pi, e or a function");
  expect("lenght_m*phi", 1, "did you mean length_m?");
  expect("phi phi", 5, "expected an operator");
  expect("2phi", 2, "multiplication is written *");
  expect("a(phi)", 2, "no function");
  expect("atan2(phi)", 10, "second argument of atan2");
  expect("sin(phi, a)", 8, "sin takes one argument");
  expect("phi**2", 5, "a power is written ^");
  expect("1e999", 1, "beyond what a double holds");
  expect("1.2.3", 4, "expected an operator");
  expect("phi)", 4, "unexpected ')'");
  expect("φ + 1", 1, "unexpected 'φ'");
  expect("phi + φ", 7, "unexpected 'φ'");
  expect("system(phi)", 1, "unknown name 'system'");
  expect("sin phi", 5, "expected '(' after sin");
  expect(std::string("phi\0", 4), 4, "control character");
}

TEST(Formula, TenThousandCharactersAndParenthesesAreRefused) {
  EXPECT_TRUE(holds(fault(std::string(10000, '1')).what, "10000 characters"));
  EXPECT_EQ(fault(std::string(10000, '(')).allowed, "2000");
  EXPECT_TRUE(holds(fault(std::string(1500, '(')).what, "nested too deeply"));
  EXPECT_TRUE(holds(fault(std::string(1500, '-').append("1")).what, "nested too deeply"));
  std::string tower = "phi";
  for (int i = 0; i < 300; ++i) tower += "^phi";
  EXPECT_TRUE(holds(fault(tower).what, "nested too deeply"));
}

TEST(Formula, ALongSumIsNoDepth) {
  std::string sum = "0";
  for (int i = 0; i < 600; ++i) sum += "+1";
  EXPECT_EQ(value(sum), 600);
}

TEST(Formula, ParameterNamesMayNotClash) {
  for (const char* name : {"phi", "u", "v", "pi", "e", "sin", "sqrt", "2a", "a-b", "", "ä"})
    EXPECT_TRUE(parameterNameFault(name, {"phi"})) << name;
  for (const char* name : {"a", "length_m", "R2", "_x", "int"}) EXPECT_FALSE(parameterNameFault(name, {"phi"})) << name;
}

}  // namespace
}  // namespace reachlab::constraints
