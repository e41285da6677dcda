#include "constraints/formula/interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "constraints/formula/formula.h"

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

}  // namespace
}  // namespace reachlab::constraints
