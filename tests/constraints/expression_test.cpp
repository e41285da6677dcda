#include "constraints/constraint.h"
#include "constraints/curve_batch.h"
#include "constraints/formula/expression.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "constraints/formula/guards.h"
#include "constraints/formula/interval.h"
#include "constraints/formula/program.h"
#include "tests/constraints/random_formulas.h"
#include "tests/refusal.h"

/// What becomes of a formula on its way to code (a graph that is simplified, derivatives, bounds, programs; cpp_writer_test for C++), held against the same
/// formula reckoned as it is written.
namespace reachlab::constraints {
namespace {

TEST(Expressions, AreWorthWhatIsWrittenAndSoAreTheirDerivatives) {
  forManyFormulas(1, 3000, [](ExpressionGraph& graph, int root, const auto& place, const Dual& expected, double tolerance) {
    EXPECT_NEAR(valueOf(graph, root, place), expected.x, tolerance);
    EXPECT_NEAR(valueOf(graph, graph.differentiate(std::array{root}, 0)[0], place), expected.du, tolerance);
    EXPECT_NEAR(valueOf(graph, graph.differentiate(std::array{root}, 1)[0], place), expected.dv, tolerance);
  });
}

TEST(Expressions, HaveNoPowersWhereTheyAreWrittenOut) {
  forManyFormulas(2, 500, [](ExpressionGraph& graph, int root, const auto& place, const Dual& expected, double tolerance) {
    const std::vector<int> written = graph.expandPowers(std::array{root});
    EXPECT_NEAR(valueOf(graph, written[0], place), expected.x, tolerance);
    const std::vector<bool> needed = graph.reachableFrom(written);
    for (int id = 0; id < graph.size(); ++id) EXPECT_FALSE(needed[id] && graph.node(id).op == Op::PowInt);
  });
}

TEST(Expressions, AreBoundedByAllTheirValuesOnABox) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  forManyFormulas(3, 2000, [&](ExpressionGraph& graph, int root, const auto& place, const Dual& expected, double tolerance) {
    IntervalEvaluator bounds(graph, std::array{root}, kShape);
    EXPECT_EQ(bounds.evaluate({Interval{place[0], place[0]}, {place[1], place[1]}})[0], Finiteness::Finite);
    EXPECT_NEAR(bounds.rangeOf(0).lo, expected.x, tolerance);
    EXPECT_NEAR(bounds.rangeOf(0).hi, expected.x, tolerance);
    const double width = 3 * uniform(random), across = 3 * uniform(random);
    const Finiteness known = bounds.evaluate({Interval{place[0] - width, place[0] + width}, {place[1] - across, place[1] + across}})[0];
    EXPECT_NE(known, Finiteness::Nowhere);
    const Interval range = bounds.rangeOf(0);
    for (int i = 0; i < 10; ++i) {
      const double value =
          valueOf(graph, root, {place[0] + width * (2 * uniform(random) - 1), place[1] + across * (2 * uniform(random) - 1)});
      if (!std::isfinite(value)) {
        EXPECT_NE(known, Finiteness::Finite);
        continue;
      }
      EXPECT_LE(range.lo, value + 1e-9 * (1 + std::abs(value)));
      EXPECT_GE(range.hi, value - 1e-9 * (1 + std::abs(value)));
    }
  });
}

TEST(Expressions, AreWrittenAsFormulasThatReadBack) {
  forManyFormulas(4, 1000, [](ExpressionGraph& graph, int root, const auto& place, const Dual& expected, double tolerance) {
    const std::string text = writeFormula(graph, root, kVariables, kParameters, 100000);
    if (text.find_first_of("ni") != std::string::npos && text.find("inf") != std::string::npos) return;  // 1/0 in a part that is left
    ExpressionGraph again;
    EXPECT_NEAR(valueOf(again, nodeOf(again, text), place), expected.x, 1e6 * tolerance) << text << ": six digits of a number";
  });
}

// Each formula with its guards as "argument level": what decides, and the value at which the operation is not analytic.
TEST(Expressions, AreGuardedWhereAnOperationIsNotAnalytic) {
  std::istringstream rows(
      "abs(u): u 0; sign(u): u 0; sqrt(u): u 0; log(u): u 0; v/u: u 0; asin(u): u 1, u -1; acos(u): u 1, u -1; tan(u): cos(u) 0; "
      "atan2(u, v): u 0; atan2(0, v): v 0; atan2(1, v):; atan2(a - a, v): v 0; u^1.5: u 0; u^a: u 0; u^v: u 0; u^65:; u^(-65): u 0; "
      "u^3:; 2^u:; abs(a):; 1/a:; sin(u) + cosh(v)*exp(u):; abs(abs(u) - v): u 0, abs(u) - v 0; ");
  for (std::string row; std::getline(rows >> std::ws, row, ';');) {
    const std::string text = row.substr(0, row.find(':'));
    ExpressionGraph graph;
    const int root = nodeOf(graph, text);
    std::string told = text + ":";
    for (const Guard& guard : findGuards(graph, std::array{root}, kShape)) {
      told += (told.back() == ':' ? " " : ", ") + writeFormula(graph, guard.argument, kVariables, kParameters) + " " +
              std::to_string(static_cast<int>(guard.level));
      EXPECT_EQ(guard.branches(), guard.op == Op::Abs || guard.op == Op::Sign || guard.op == Op::Atan2);
    }
    EXPECT_EQ(told, row);
  }
}

TEST(Expressions, AreCutWhereTheyAreTooLongToBeTold) {
  ExpressionGraph graph;
  const int root = nodeOf(graph, "u + v*(a + b)^2 - 3*sin(u)");
  const std::string whole = writeFormula(graph, root, kVariables, kParameters);
  EXPECT_EQ(whole, "u + v*(a + b)^2 - 3*sin(u)");
  EXPECT_EQ(writeFormula(graph, root, kVariables, kParameters, whole.size()), whole);
  EXPECT_EQ(writeFormula(graph, root, kVariables, kParameters, 5), "u + v…");
  EXPECT_EQ(writeFormula(graph, nodeOf(graph, "pi*u - v/(u/b)"), kVariables, kParameters), "pi*u - v/(u/b)");
  EXPECT_EQ(writeFormula(graph, nodeOf(graph, "atan2(u - (v - a), (-2)*u)^v"), kVariables, kParameters), "atan2(u - (v - a), -(2*u))^v");
}

TEST(Expressions, StayWhatTheyAreOnTheSideOfTheirBranches) {
  forManyFormulas(6, 2000, [](ExpressionGraph& graph, int root, const auto& place, const Dual& expected, double tolerance) {
    const std::vector<Guard> guards = findGuards(graph, std::array{root}, kShape);
    std::vector<int> signs;
    for (const Guard& guard : guards) {
      const double off = valueOf(graph, guard.argument, place) - guard.level;
      EXPECT_NE(off, 0);
      signs.push_back(off > 0 ? 1 : -1);
    }
    const std::vector<int> frozen = freezeBranches(graph, std::array{root}, guards, signs);
    EXPECT_NEAR(valueOf(graph, frozen[0], place), expected.x, tolerance);
    for (const Guard& guard : findGuards(graph, frozen, kShape)) EXPECT_NE(guard.op, Op::Abs);
  });
}

template <class Point, std::size_t Roots>
void expectProgram(const std::vector<std::string>& variables, unsigned seed,
                   const std::function<Point(const Program&, const std::array<double, 2>&)>& run) {
  Terms terms(seed, variables);
  for (int i = 0; i < 300; ++i) {
    ExpressionGraph graph;
    std::vector<int> roots;
    std::vector<Term> all;
    std::string texts;
    for (std::size_t k = 0; k < Roots; ++k) {
      // Some results are those before them, numbers, or a variable: they are copied.
      all.push_back(k % 5 == 4 ? all[k - 3] : terms.make(static_cast<int>(k % 4)));
      roots.push_back(nodeOf(graph, all[k].text, variables));
      texts += all[k].text + "\n";
    }
    const Program program = compileProgram(graph, roots, 2, static_cast<int>(variables.size()));
    for (const std::array<double, 2>& place : kPlaces) {
      const Point point = run(program, place);
      static_assert(sizeof(Point) == Roots * sizeof(double));
      double results[Roots];
      std::memcpy(results, &point, sizeof results);
      for (std::size_t k = 0; k < Roots; ++k) {
        const Dual expected = all[k].at(place[0], place[1]);
        if (expected.rough) continue;
        EXPECT_NEAR(results[k], expected.x, 1e-11 * (1 + expected.size * expected.size)) << k << " of\n" << texts;
      }
    }
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Programs, GiveEachResultOfASurface) {
  expectProgram<SurfacePoint, 18>(kVariables, 7, [](const Program& program, const auto& at) {
    SurfacePoint point;
    evaluateSurfaceProgram(&program, kShape, at[0], at[1], point);
    return point;
  });
}

TEST(Programs, GiveEachResultOfACurveSinglyAndInABatch) {
  expectProgram<CurvePoint, 9>({"phi"}, 8, [](const Program& program, const auto& at) {
    CurvePoint point;
    evaluateCurveProgram(&program, kShape, at[0], point);
    double phis[kBatchLanes];
    for (int lane = 0; lane < kBatchLanes; ++lane) phis[lane] = at[0] + 0.01 * (lane - 3);
    CurveBatch batch;
    evaluateCurveBatchProgram(&program, kShape, phis, batch);
    double single[9];
    std::memcpy(single, &point, sizeof single);
    for (std::size_t k = 0; k < 9; ++k) {
      const double in = (k < 3 ? batch.r : k < 6 ? batch.rPhi : batch.rPhiPhi)[k % 3][3];
      EXPECT_TRUE(in == single[k] || (std::isnan(in) && std::isnan(single[k]))) << k;
    }
    return point;
  });
}

/// Whether both sides of "ONE = OTHER" are the same node of a graph.
bool areOne(const std::string& pair) {
  const std::size_t sign = pair.find(" = ");
  ExpressionGraph graph;
  return nodeOf(graph, pair.substr(0, sign)) == nodeOf(graph, pair.substr(sign + 3));
}

TEST(Expressions, ThatAreOneAreWrittenOnce) {
  std::istringstream pairs(
      "u + u = 2*u; u - u = 0; 2*u + 3*u = 5*u; 2*u - 3*u = -u; u + v = v + u; u*v = v*u; u - 0 = u; 0 + u = u; "
      "0 - u = -u; u*0 = 0; 1*u = u; u - (-v) = u + v; -u + v = v - u; -u - v = -(u + v); -(-u) = u; "
      "2*u + 2*v = 2*(u + v); 2*u - 2*v = 2*(u - v); (-u)*(-v) = u*v; (-u)*v = -(u*v); (2*u)*(3*v) = 6*(u*v); "
      "3*(2*u) = 6*u; (-1)*u = -u; u*u = u^2; u^2*u^3 = u^5; u^60*u^4 = u^64; (u^2)^3 = u^6; (u^8)^8 = u^64; "
      "u*(1/v) = u/v; (1/v)*u = u/v; u/2 = 0.5*u; 0/u = 0; u/u = 1; (-u)/v = -(u/v); u/(-v) = -(u/v); "
      "(2*u)/v = 2*(u/v); (-2)/u = -(2/u); 6/4 = 1.5; u^0 = 1; u^1 = u; u^(-2) = 1/u^2; (-u)^2 = u^2; (-u)^3 = -(u^3); "
      "(2*u)^3 = 8*u^3; 2^10 = 1024; 2^0.5 = sqrt(2); u^0.5 = sqrt(u); sqrt(u^2) = abs(u); sqrt(u^4) = u^2; "
      "sqrt(u^6) = abs(u^3); sin(-u) = -sin(u); tan(-u) = -tan(u); asin(-u) = -asin(u); atan(-u) = -atan(u); "
      "sinh(-u) = -sinh(u); tanh(-u) = -tanh(u); sign(-u) = -sign(u); cos(-u) = cos(u); cosh(-u) = cosh(u); "
      "abs(-u) = abs(u); sin(u)^2 + cos(u)^2 = 1; cos(u)^2 + sin(u)^2 = 1; a*sin(u)^2 + a*cos(u)^2 = a; "
      "sin(u)^2*a + a*cos(u)^2 = a; a*cos(u)^2 + sin(u)^2*a = a; (a*sin(u))^2 + (cos(u)*a)^2 = a^2; "
      "(cos(u)*a)^2 + (sin(u)*a)^2 = a^2; sin(2)*1 = sin(2); sqrt(0.25) = 0.5; ");
  for (std::string pair; std::getline(pairs >> std::ws, pair, ';');) EXPECT_TRUE(areOne(pair)) << pair;
}

TEST(Expressions, ThatAreNotOneAreNot) {
  std::istringstream pairs(
      "u - v = v - u; u/v = v/u; u^60*u^5 = u^65; acos(-u) = -acos(u); exp(-u) = -exp(u); sqrt(-u) = -sqrt(u); "
      "sin(u)^2 - cos(u)^2 = 1; sin(u)^2 + cos(v)^2 = 1; sin(u)^3 + cos(u)^3 = 1; sin(u)^2 + sin(u)^2 = 1; "
      "a*sin(u)^2 + b*cos(u)^2 = a; (a*sin(u))^2 + (b*cos(u))^2 = a^2; (a*sin(u))^2 + (a*cos(v))^2 = a^2; "
      "(a*sin(u))^2 + (a*sin(u))^2 = a^2; (a*sin(u))^3 + (a*cos(u))^3 = a^2; (a*sin(u))^2 + a*cos(u) = a^2; 1/0 = 0; 0/0 = 0; 0/0 = 1; "
      "u/0 = u; ");
  for (std::string pair; std::getline(pairs >> std::ws, pair, ';');) EXPECT_FALSE(areOne(pair)) << pair;
}

// The square of a root is its argument where that is never negative; else it would lose its end.
TEST(Expressions, KnowWhatIsNeverNegativeByItsForm) {
  ExpressionGraph graph;
  for (const char* never : {"u^2", "u^4", "abs(u)", "exp(u)", "cosh(u)", "sqrt(u)", "3", "u^2 + 1", "u^2*abs(v)", "u^2/exp(v)", "abs(u)^3"})
    EXPECT_TRUE(graph.isNeverNegative(nodeOf(graph, never))) << never;
  for (const char* maybe :
       {"u", "u^3", "-3", "u^2 - 1", "u*abs(v)", "abs(v)*u", "u/exp(v)", "exp(u)/v", "u^2 + v", "v + u^2", "sin(u)", "a"})
    EXPECT_FALSE(graph.isNeverNegative(nodeOf(graph, maybe))) << maybe;
  EXPECT_EQ(nodeOf(graph, "sqrt(u^2 + 1)^2"), nodeOf(graph, "u^2 + 1"));
  EXPECT_EQ(nodeOf(graph, "sqrt(u^2 + 1)^6"), nodeOf(graph, "(u^2 + 1)^3"));
  EXPECT_NE(nodeOf(graph, "sqrt(u)^2"), nodeOf(graph, "u"));
}

TEST(Expressions, AreRefusedWhereTheyGrowTooLarge) {
  ExpressionGraph graph;
  int sum = graph.variable(0);
  EXPECT_EQ(refusalOf([&] {
              for (int i = 2; i < 30000; ++i) sum = graph.add(sum, graph.apply(Op::Sin, graph.mul(graph.constant(i), graph.variable(0))));
            }),
            "the formula with its derivatives is too large; allowed: 20000 operations");
  EXPECT_EQ(graph.size(), 20000);
}

}  // namespace
}  // namespace reachlab::constraints
