#include "constraints/formula/interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>

#include "constraints/formula/formula.h"
#include "constraints/formula/parser.h"

namespace reachlab::constraints {
namespace {

// Each is monotone in u and in v on either side of v = 0, so that its range over a box is that of the box's corners.
TEST(IntervalEvaluator, BoundsWhatIsMonotoneByItsCorners) {
  const std::pair<const char*, double (*)(double, double)> cases[] = {
      {"u + v", [](double u, double v) { return u + v; }},
      {"u - v", [](double u, double v) { return u - v; }},
      {"u * v", [](double u, double v) { return u * v; }},
      {"u / v", [](double u, double v) { return u / v; }},
      {"1 / v", [](double, double v) { return 1 / v; }},
      {"exp(u) / v", [](double u, double v) { return std::exp(u) / v; }},
      {"u^3 + sinh(v)", [](double u, double v) { return u * u * u + std::sinh(v); }},
  };
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-3, 3);
  for (const auto& [text, value] : cases) {
    const auto formula = compileFormula({ConstraintKind::Surface, {"u", "v", text}, {}}, "here");
    IntervalEvaluator evaluator(formula->graph, std::span(formula->roots).subspan(2, 1), nullptr);
    for (int box = 0; box < 200; ++box) {
      const auto [uLo, uHi] = std::minmax({uniform(random), uniform(random)});
      double vLo = 0.1 + std::abs(uniform(random)), vHi = vLo + std::abs(uniform(random));
      if (box % 2 == 0) std::tie(vLo, vHi) = std::pair{-vHi, -vLo};
      const double corners[] = {value(uLo, vLo), value(uLo, vHi), value(uHi, vLo), value(uHi, vHi)};
      const auto [least, most] = std::minmax_element(std::begin(corners), std::end(corners));
      EXPECT_EQ(evaluator.evaluate({Interval{uLo, uHi}, Interval{vLo, vHi}})[0], Finiteness::Finite) << text;
      const Interval range = evaluator.rangeOf(0);
      EXPECT_NEAR(range.lo, *least, 1e-12 * (1 + std::abs(*least))) << text;
      EXPECT_NEAR(range.hi, *most, 1e-12 * (1 + std::abs(*most))) << text;
    }
  }
}

// Neither too narrow nor wider than it need be: what is positive but for its end is not told to change its sign.
TEST(IntervalEvaluator, TheSignOfAnIntervalReachesFromThatOfOneEndToThatOfTheOther) {
  const auto signOf = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
  const auto formula = compileFormula({ConstraintKind::Surface, {"u", "v", "sign(u)"}, {}}, "here");
  IntervalEvaluator evaluator(formula->graph, std::span(formula->roots).subspan(2, 1), nullptr);
  const double ends[] = {-2, -0.5, 0, 0.5, 1, 2};
  for (const double lo : ends)
    for (const double hi : ends) {
      if (hi < lo) continue;
      evaluator.evaluate({Interval{lo, hi}, Interval{0, 1}});
      EXPECT_EQ(evaluator.rangeOf(0).lo, signOf(lo)) << lo << " to " << hi;
      EXPECT_EQ(evaluator.rangeOf(0).hi, signOf(hi)) << lo << " to " << hi;
    }
}

struct Known {
  const char* text;
  Interval u, v, range;
  Finiteness finiteness = Finiteness::Finite;
};

// Each row by hand: what the operation does on that side of its crests, its cut, its pole or its end.
TEST(IntervalEvaluator, KnowsCrestsCutsPolesAndEnds) {
  constexpr double kPi = std::numbers::pi, kInf = std::numeric_limits<double>::infinity();
  const Interval any{1, 2}, all{-kInf, kInf};
  const Known rows[] = {
      {"sin(u)", {0.2, 1}, any, {std::sin(0.2), std::sin(1)}},
      {"sin(u)", {1, 2}, any, {std::sin(1), 1}},
      {"sin(u)", {2, 4}, any, {std::sin(4), std::sin(2)}},
      {"sin(u)", {4, 5}, any, {-1, std::sin(4)}},
      {"sin(u)", {-2, -1}, any, {-1, std::sin(-1)}},
      {"sin(u)", {1, 5}, any, {-1, 1}},
      {"sin(u)", {7, 13.2}, any, {-1, 1}},
      {"sin(u)", {7, 20}, any, {-1, 1}},
      {"cos(u)", {0.2, 1}, any, {std::cos(1), std::cos(0.2)}},
      {"cos(u)", {-1, 0.5}, any, {std::cos(1), 1}},
      {"cos(u)", {3, 4}, any, {-1, std::cos(4)}},
      {"cos(u)", {6, 7}, any, {std::cos(7), 1}},
      {"tan(u)", {-1, 1.2}, any, {std::tan(-1), std::tan(1.2)}},
      {"tan(u)", {2, 4}, any, {std::tan(2), std::tan(4)}},
      {"tan(u)", {1, 2}, any, all, Finiteness::Unknown},
      {"asin(u)", {-0.5, 0.75}, any, {std::asin(-0.5), std::asin(0.75)}},
      {"asin(u)", {-1, 1}, any, {-kPi / 2, kPi / 2}},
      {"asin(u)", {-2, 0.5}, any, {-kPi / 2, std::asin(0.5)}, Finiteness::Touching},
      {"asin(u)", {0.5, 1.25}, any, {std::asin(0.5), kPi / 2}, Finiteness::Touching},
      {"asin(u)", {1.5, 2}, any, {kPi / 2, kPi / 2}, Finiteness::Nowhere},
      {"acos(u)", {-0.5, 0.75}, any, {std::acos(0.75), std::acos(-0.5)}},
      {"acos(u)", {-3, -1.5}, any, {kPi, kPi}, Finiteness::Nowhere},
      {"acos(u)", {-1.5, 0}, any, {kPi / 2, kPi}, Finiteness::Touching},
      {"log(u)", {0.5, 3}, any, {std::log(0.5), std::log(3)}},
      {"log(u)", {0, 3}, any, all, Finiteness::Unknown},
      {"log(u)", {-1, 0}, any, all, Finiteness::Nowhere},
      {"sqrt(u)", {0.25, 4}, any, {0.5, 2}},
      {"sqrt(u)", {0, 4}, any, {0, 2}},
      {"sqrt(u)", {-1, 4}, any, {0, 2}, Finiteness::Touching},
      {"sqrt(u)", {-2, -1}, any, {0, 0}, Finiteness::Nowhere},
      {"abs(u)", {-3, 2}, any, {0, 3}},
      {"abs(u)", {-3, -2}, any, {2, 3}},
      {"abs(u)", {2, 5}, any, {2, 5}},
      {"cosh(u)", {-1, 2}, any, {1, std::cosh(2)}},
      {"cosh(u)", {-2, -1}, any, {std::cosh(1), std::cosh(2)}},
      {"cosh(u)", {1, 3}, any, {std::cosh(1), std::cosh(3)}},
      {"exp(u)", {1, 1000}, any, {std::exp(1), kInf}, Finiteness::Unknown},
      {"exp(u)", {900, 1000}, any, {kInf, kInf}, Finiteness::Nowhere},
      {"u^2", {-3, 2}, any, {0, 9}},
      {"u^2", {-3, -2}, any, {4, 9}},
      {"u^3", {-3, 2}, any, {-27, 8}},
      {"1/u", {2, 4}, any, {0.25, 0.5}},
      {"1/u", {-4, -2}, any, {-0.5, -0.25}},
      {"1/u", {-1, 2}, any, all, Finiteness::Unknown},
      {"1/u", {0, 2}, any, all, Finiteness::Unknown},
      {"1/u", {0, 0}, any, all, Finiteness::Nowhere},
      {"1/u", {-2, 0}, any, all, Finiteness::Unknown},
      {"u^v", {2, 3}, {-1, 2}, {1.0 / 3, 9}},
      {"u^v", {0.5, 2}, {1, 3}, {0.125, 8}},
      {"u^v", {-2, 3}, {0, 0}, {1, 1}},
      {"u^v", {-2, 3}, {2, 2}, {0, 9}},
      {"u^v", {-2, 3}, {3, 3}, {-8, 27}},
      {"u^v", {-4, -2}, {-1, -1}, {-0.5, -0.25}},
      {"u^v", {-4, -2}, {-2, -2}, {0.0625, 0.25}},
      {"u^v", {-4, -2}, {0.5, 0.5}, all, Finiteness::Nowhere},
      {"u^v", {-4, 4}, {0.5, 0.5}, {0, 2}, Finiteness::Touching},
      {"u^v", {0, 4}, {0.5, 0.5}, {0, 2}},
      {"u^v", {0, 0.25}, {0.5, 0.5}, {0, 1}},
      {"u^v", {0, 4}, {0.5, 1.5}, {0, 8}},
      {"u^v", {0, 4}, {-1, -1}, all, Finiteness::Unknown},
      {"u^v", {0, 0}, {-1, -1}, all, Finiteness::Nowhere},
      {"u^v", {-1, 4}, {-0.5, 2}, all, Finiteness::Unknown},
      {"atan2(u, v)", {1, 2}, {3, 4}, {std::atan2(1, 4), std::atan2(2, 3)}},
      {"atan2(u, v)", {1, 2}, {-4, 3}, {std::atan2(1, 3), std::atan2(1, -4)}},
      {"atan2(u, v)", {-2, -1}, {-4, 3}, {std::atan2(-1, -4), std::atan2(-1, 3)}},
      {"atan2(u, v)", {-1, 2}, {3, 4}, {std::atan2(-1, 3), std::atan2(2, 3)}},
      {"atan2(u, v)", {-1, 2}, {-4, 3}, {-kPi, kPi}},
      {"0*(1/u)", {-1, 1}, any, {0, 0}},
      {"(1/u)*v", {-1, 1}, any, all, Finiteness::Unknown},
      {"log(u) + 1/v", {-1, 0}, {-1, 1}, all, Finiteness::Nowhere},
      {"exp(v) - exp(u)", {0, 1000}, {900, 1000}, all, Finiteness::Nowhere},
      {"1/u - 1/u^2", {-1, 1}, any, all, Finiteness::Unknown},
  };
  for (const Known& row : rows) {
    ExpressionGraph graph;
    const int root = parseFormula(row.text, {{"u", "v"}, {}}, graph).root;
    IntervalEvaluator evaluator(graph, std::array{root}, nullptr);
    EXPECT_EQ(evaluator.evaluate({row.u, row.v})[0], row.finiteness) << row.text << " on " << row.u.lo << " to " << row.u.hi;
    const Interval range = evaluator.rangeOf(0);
    const auto same = [](double a, double b) { return a == b || std::abs(a - b) <= 1e-14 * (1 + std::abs(b)); };
    EXPECT_TRUE(same(range.lo, row.range.lo) && same(range.hi, row.range.hi))
        << row.text << " on " << row.u.lo << " to " << row.u.hi << ": " << range.lo << " to " << range.hi;
  }
}

}  // namespace
}  // namespace reachlab::constraints
