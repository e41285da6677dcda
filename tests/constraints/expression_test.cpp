#include "constraints/constraint.h"
#include "constraints/curve_batch.h"
#include "constraints/formula/expression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <sstream>

#include "base/error.h"
#include "base/math/vec3.h"
#include "constraints/formula/cpp_writer.h"
#include "constraints/formula/formula.h"
#include "constraints/formula/guards.h"
#include "constraints/formula/interval.h"
#include "constraints/formula/parser.h"
#include "constraints/formula/program.h"
#include "tests/refusal.h"

/// What becomes of a formula on its way to code (a graph that is simplified, derivatives, bounds, programs, C++), held against the same
/// formula reckoned as it is written.
namespace reachlab::constraints {
namespace {

constexpr double kShape[] = {0.7, -1.3};

/// A number with its two partial derivatives, by the rules of differentials. Rough: at a place where rounding would be magnified.
struct Dual {
  double x = 0, du = 0, dv = 0, size = 0;
  bool rough = false;
};
Dual chained(const Dual& a, const Dual& b, double x, double da, double db, bool rough = false) {
  const auto term = [](double rate, double change) { return change == 0 ? 0 : rate * change; };
  Dual d{x, term(da, a.du) + term(db, b.du), term(da, a.dv) + term(db, b.dv)};
  d.size = std::max({a.size, b.size, std::abs(x), std::abs(d.du), std::abs(d.dv)});
  d.rough = rough || a.rough || b.rough || !(d.size < 1e4);
  return d;
}

struct Term {
  std::string text;
  std::function<Dual(double, double)> at;
};

Term unary(
    const std::string& before, const std::string& after, const Term& a, double (*f)(double), double (*rate)(double),
    bool (*rough)(double) = [](double) { return false; }) {
  return {before + a.text + after, [=](double u, double v) {
            const Dual x = a.at(u, v);
            return chained(x, {}, f(x.x), rate(x.x), 0, rough(x.x));
          }};
}
Term binary(char sign, const Term& a, const Term& b) {
  return {"(" + a.text + sign + b.text + ")", [=](double u, double v) {
            const Dual x = a.at(u, v), y = b.at(u, v);
            switch (sign) {
              case '+': return chained(x, y, x.x + y.x, 1, 1);
              case '-': return chained(x, y, x.x - y.x, 1, -1);
              case '*': return chained(x, y, x.x * y.x, y.x, x.x);
              case '/': return chained(x, y, x.x / y.x, 1 / y.x, -x.x / y.x / y.x, !(std::abs(y.x) > 0.1));
              default:
                return chained(x, y, std::pow(x.x, y.x), y.x * std::pow(x.x, y.x - 1), std::pow(x.x, y.x) * std::log(x.x), !(x.x > 0.1));
            }
          }};
}
Term powered(const Term& a, int n) {
  return {"((" + a.text + ")^(" + std::to_string(n) + "))", [=](double u, double v) {
            const Dual x = a.at(u, v);
            return chained(x, {}, std::pow(x.x, n), n == 0 ? 0 : n * std::pow(x.x, n - 1), 0, n < 0 && !(std::abs(x.x) > 0.1));
          }};
}
Term turned(const Term& a, const Term& b) {
  return {"atan2(" + a.text + ", " + b.text + ")", [=](double u, double v) {
            const Dual y = a.at(u, v), x = b.at(u, v);
            const double square = x.x * x.x + y.x * y.x;
            return chained(y, x, std::atan2(y.x, x.x), x.x / square, -y.x / square, !(square > 0.01) || std::abs(y.x) < 0.01);
          }};
}

class Terms {
 public:
  Terms(unsigned seed, std::vector<std::string> variables) : random_(seed), variables_(std::move(variables)) {}
  Term make(int depth) {
    if (depth == 0 || pick(8) == 0) return leaf();
    const auto one = [&] { return make(depth - 1); };
    using std::abs;
    switch (pick(26)) {
      case 0:
      case 1:
      case 2: return binary('+', one(), one());
      case 3:
      case 4:
      case 5: return binary('-', one(), one());
      case 6:
      case 7:
      case 8: return binary('*', one(), one());
      case 9:
      case 10: return binary('/', one(), one());
      case 11:
      case 12: {
        const int exponents[] = {-2, -1, 0, 1, 2, 2, 2, 3, 4, 6};
        const Term base = one();
        return powered(base, exponents[pick(10)]);
      }
      case 13:
        return unary(
            "(-(", "))", one(), [](double x) { return -x; }, [](double) { return -1.0; });
      case 14: return unary("sin(", ")", one(), std::sin, std::cos);
      case 15: return unary("cos(", ")", one(), std::cos, [](double x) { return -std::sin(x); });
      case 16:
        return unary(
            "sqrt(", ")", one(), std::sqrt, [](double x) { return 0.5 / std::sqrt(x); }, [](double x) { return !(x > 0.1); });
      case 17:
        return unary(
            "abs(", ")", one(), std::fabs, [](double x) { return x < 0 ? -1.0 : 1.0; }, [](double x) { return abs(x) < 0.01; });
      case 18:
        return unary(
            "sign(", ")", one(), [](double x) { return x < 0 ? -1.0 : 1.0; }, [](double) { return 0.0; },
            [](double x) { return abs(x) < 0.01; });
      case 19: return unary("exp(", ")", one(), std::exp, std::exp);
      case 20:
        return unary(
            "log(", ")", one(), std::log, [](double x) { return 1 / x; }, [](double x) { return !(x > 0.1); });
      case 21: {
        const auto rate = [](double x) { return 1 / std::sqrt(1 - x * x); };
        if (pick(2) == 0) return unary("asin(", ")", one(), std::asin, rate, [](double x) { return !(abs(x) < 0.9); });
        return unary(
            "acos(", ")", one(), std::acos, [](double x) { return -1 / std::sqrt(1 - x * x); }, [](double x) { return !(abs(x) < 0.9); });
      }
      case 22: {
        if (pick(2) == 0) return unary("atan(", ")", one(), std::atan, [](double x) { return 1 / (1 + x * x); });
        return unary(
            "tan(", ")", one(), std::tan, [](double x) { return 1 + std::tan(x) * std::tan(x); },
            [](double x) { return !(abs(std::cos(x)) > 0.1); });
      }
      case 23: {
        if (pick(2) == 0) return unary("sinh(", ")", one(), std::sinh, std::cosh);
        return unary("cosh(", ")", one(), std::cosh, std::sinh);
      }
      case 24: {
        if (pick(2) == 0) return unary("tanh(", ")", one(), std::tanh, [](double x) { return 1 - std::tanh(x) * std::tanh(x); });
        return turned(one(), one());
      }
      default: return binary('^', one(), one());
    }
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  Term leaf() {
    const int which = pick(7);
    if (which < 3) {
      const std::size_t k = static_cast<std::size_t>(pick(static_cast<int>(variables_.size())));
      return {variables_[k], [k](double u, double v) { return k == 0 ? Dual{u, 1, 0, 1} : Dual{v, 0, 1, 1}; }};
    }
    if (which < 5) {
      const std::size_t k = static_cast<std::size_t>(which - 3);
      return {k == 0 ? "a" : "b", [k](double, double) { return Dual{kShape[k], 0, 0, 2}; }};
    }
    const std::pair<const char*, double> numbers[] = {{"0", 0},     {"1", 1},     {"2", 2},          {"3", 3},
                                                      {"0.5", 0.5}, {"(-2)", -2}, {"(-0.25)", -0.25}};
    const auto& [text, value] = numbers[pick(7)];
    return {text, [value = value](double, double) { return Dual{value, 0, 0, 5}; }};
  }
  std::mt19937 random_;
  std::vector<std::string> variables_;
};

const std::vector<std::string> kVariables{"u", "v"}, kParameters{"a", "b"};
constexpr std::array<double, 2> kPlaces[] = {{0.37, 1.21}, {-0.83, 0.45}, {1.9, -1.4}};

int nodeOf(ExpressionGraph& graph, const std::string& text, const std::vector<std::string>& variables = kVariables,
           const std::vector<std::string>& parameters = kParameters) {
  const ParsedFormula parsed = parseFormula(text, {variables, parameters}, graph);
  EXPECT_FALSE(parsed.fault) << text;
  return parsed.root;
}
double valueOf(const ExpressionGraph& graph, int root, const std::array<double, 2>& at) {
  return evaluateNodes(graph, std::array{root}, kShape, at.data())[0];
}

std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) text.replace(at, from.size(), to);
  return text;
}

/// Calls `use(graph, root, place, expected, tolerance)` for many formulas at those places where rounding is not magnified.
template <class Use>
void forManyFormulas(unsigned seed, int count, Use&& use) {
  Terms terms(seed, kVariables);
  int looked = 0;
  for (int i = 0; i < count; ++i) {
    const Term term = terms.make(5);
    ExpressionGraph graph;
    const int root = nodeOf(graph, term.text);
    for (const std::array<double, 2>& place : kPlaces) {
      const Dual expected = term.at(place[0], place[1]);
      if (expected.rough) continue;
      ++looked;
      SCOPED_TRACE(term.text);
      use(graph, root, place, expected, 1e-11 * (1 + expected.size * expected.size));
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(looked, count / 2);
}

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
    for (int id = 0; id < graph.size(); ++id) EXPECT_FALSE(needed[static_cast<std::size_t>(id)] && graph.node(id).op == Op::PowInt);
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
    for (const Guard& guard : findGuards(graph, {root}, kShape)) {
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

/// A line of C++ as a formula: without std::, with sign for signOf and (x)^(y) for pow(x, y).
std::string asFormula(std::string text) {
  text = replacedAll(replacedAll(text, "std::", ""), "signOf", "sign");
  for (std::size_t at; (at = text.find("pow(")) != std::string::npos;) {
    int depth = 0;
    std::size_t end = at + 3;
    for (; end < text.size(); ++end) {
      depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
      if (depth == 0) break;
      if (depth == 1 && text[end] == ',') text.replace(end, 2, ")^("), end += 2;
    }
    text.insert(end, ")").replace(at, 3, "(");
  }
  return text;
}

/// What `expressions` are worth behind C++ statements "const double NAME = EXPRESSION;".
std::vector<double> runCpp(const std::string& statements, const std::vector<std::string>& expressions, std::vector<std::string> names,
                           std::vector<double> values) {
  const auto worth = [&](const std::string& text) {
    ExpressionGraph graph;
    const int root = nodeOf(graph, asFormula(text), {}, names);
    return root < 0 ? NAN : evaluateNodes(graph, std::array{root}, values.data(), nullptr)[0];
  };
  const auto name = [&](const std::string& as, double value) {
    names.push_back(as);
    values.push_back(value);
  };
  for (std::size_t at = 0; at < statements.size();) {
    const std::size_t end = std::min(statements.find(";\n", at), statements.size());
    const std::string line = statements.substr(at, end - at);
    at = end + 2;
    if (const std::size_t call = line.find("sinCos"); call != std::string::npos) {  // of ANGLE, SINE, COSINE
      const std::size_t open = line.find('(', call), second = line.rfind(", "), first = line.rfind(", ", second - 1);
      const double angle = worth(line.substr(open + 1, first - open - 1));
      name(line.substr(first + 2, second - first - 2), std::sin(angle));
      name(line.substr(second + 2, line.size() - second - 3), std::cos(angle));
    } else if (const std::size_t number = line.find("const double "), is = line.find(" = "); number != std::string::npos) {
      name(line.substr(number + 13, is - number - 13), worth(line.substr(is + 3)));
    }
  }
  std::vector<double> result;
  for (const std::string& expression : expressions) result.push_back(worth(expression));
  return result;
}

TEST(Expressions, AreWrittenAsCppThatIsWorthTheSame) {
  forManyFormulas(5, 1000, [](ExpressionGraph& graph, int root, const auto& place, const Dual& expected, double tolerance) {
    const std::vector<int> roots{root, graph.powInt(root, 3)};
    const CppWriter writer(graph, roots, {kVariables, kParameters, ""});
    const std::string code = writer.statements() + writer.expression(0);
    if (code.find("NAN") != std::string::npos || code.find("INFINITY") != std::string::npos) return;
    const std::vector<double> worth = runCpp(writer.statements(), {writer.expression(0), writer.expression(1)}, {"u", "v", "a", "b"},
                                             {place[0], place[1], kShape[0], kShape[1]});
    EXPECT_NEAR(worth[0], expected.x, tolerance) << code;
    EXPECT_NEAR(worth[1], std::pow(expected.x, 3), tolerance * (1 + 3 * expected.x * expected.x));
  });
}

TEST(Expressions, StayWhatTheyAreOnTheSideOfTheirBranches) {
  forManyFormulas(6, 2000, [](ExpressionGraph& graph, int root, const auto& place, const Dual& expected, double tolerance) {
    const std::vector<Guard> guards = findGuards(graph, {root}, kShape);
    std::vector<int> signs;
    for (const Guard& guard : guards) {
      const double off = valueOf(graph, guard.argument, place) - guard.level;
      EXPECT_NE(off, 0);
      signs.push_back(off > 0 ? 1 : -1);
    }
    const std::vector<int> frozen = freezeBranches(graph, {root}, guards, signs);
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

// ---- whole functions

std::shared_ptr<const CompiledFormula> compiled(ConstraintKind kind, const std::array<std::string, 3>& coordinates) {
  std::vector<std::string> parameters;
  for (const char* name : {"a", "double"})
    for (const std::string& coordinate : coordinates)
      if (coordinate.find(name) != std::string::npos && std::find(parameters.begin(), parameters.end(), name) == parameters.end())
        parameters.push_back(name);
  return compileFormula({kind, coordinates, parameters}, "here");
}
const std::array<std::string, 3> kCurve{"a*cos(phi) + double", "a*sin(phi)*exp(0.3*phi)", "abs(phi - 1)*sin(3*phi)"};
const std::array<std::string, 3> kSurface{"a*cos(u)*v^2", "double*sin(u + 2*v)", "atan2(u, v)*a"};
constexpr double kShapeOf[] = {0.7, 1.3};

/// What stands behind `before`, up to `end`.
std::string behind(const std::string& code, const std::string& before, const std::string& end) {
  const std::size_t at = code.find(before);
  EXPECT_NE(at, std::string::npos) << before << " in\n" << code;
  return at == std::string::npos ? "" : code.substr(at + before.size(), code.find(end, at) - at - before.size());
}
/// The arguments of a list, at its own commas.
std::vector<std::string> parts(const std::string& list) {
  std::vector<std::string> all(1);
  int depth = 0;
  for (const char c : list) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0) all.emplace_back();
    else if (c != ' ' || !all.back().empty()) all.back() += c;
  }
  return all;
}
std::string withShape(std::string code) {
  for (const auto& [from, to] : {std::pair{"shape[0]", "0.7"}, {"shape[1]", "1.3"}, {"elementary::", ""}})
    code = replacedAll(code, from, to);
  return code;
}
void expectVector(const std::vector<double>& got, const Vec3& expected, const std::string& what) {
  ASSERT_EQ(got.size(), 3u);
  EXPECT_NEAR(norm(Vec3{got[0], got[1], got[2]} - expected), 0, 1e-13 * (1 + norm(expected))) << what;
}

TEST(WrittenCode, OfACurveIsItsPointSinglyAndInLanes) {
  const auto formula = compiled(ConstraintKind::Curve, kCurve);
  const double phi = 1.7;
  CurvePoint point;
  evaluateCurveProgram(&formula->program, kShapeOf, phi, point);
  const std::string single = withShape(writeEvaluator(*formula, "evaluateOwn"));
  EXPECT_EQ(single.find("// {a*cos(phi) + double, a*sin(phi)*exp(0.3*phi), abs(phi - 1)*sin(3*phi)}\nvoid evaluateOwn(const void*, "
                        "[[maybe_unused]] const double* shape, [[maybe_unused]] double phi, CurvePoint& p) noexcept {\n  "),
            0u)
      << single;
  EXPECT_NE(single.find("const double doubleShape = 1.3;"), std::string::npos) << "no word of C++";
  EXPECT_NE(single.find("sinCos(phi, sinPhi, cosPhi);"), std::string::npos);
  EXPECT_NE(single.find("sin3Phi"), std::string::npos);
  const std::string batch = withShape(writeBatchEvaluator(*formula, "evaluateOwn"));
  EXPECT_EQ(batch.find("void evaluateOwnBatch(const void*, const double* shape, const double* __restrict phis, CurveBatch& __restrict p) "
                       "noexcept {\n  "),
            0u)
      << batch;
  EXPECT_NE(batch.find("  for (int lane = 0; lane < kBatchLanes; ++lane) {\n    [[maybe_unused]] const double phi = phis[lane];\n"),
            std::string::npos);
  EXPECT_NE(batch.find("    far |= sinCosNear(phi, sinPhi, cosPhi);\n"), std::string::npos);
  EXPECT_NE(batch.find("  if (far != 0) evaluateSingly(evaluateOwn, nullptr, shape, phis, p);\n}\n"), std::string::npos);
  const std::vector<std::pair<std::string, Vec3>> members{{"r", point.r}, {"rPhi", point.rPhi}, {"rPhiPhi", point.rPhiPhi}};
  const std::string inLanes =
      replacedAll(batch, "for (int lane = 0; lane < kBatchLanes; ++lane) {\n    [[maybe_unused]] const double phi = phis[lane];", "");
  for (const auto& [member, expected] : members) {
    expectVector(runCpp(single, parts(behind(single, "p." + member + " = {", "};")), {"phi"}, {phi}), expected, member);
    std::vector<std::string> lanes;
    for (int k = 0; k < 3; ++k) lanes.push_back(behind(batch, "p." + member + "[" + std::to_string(k) + "][lane] = ", ";"));
    expectVector(runCpp(inLanes, lanes, {"phi"}, {phi}), expected, member);
  }
}

TEST(WrittenCode, OfASurfaceIsItsPoint) {
  const auto formula = compiled(ConstraintKind::Surface, kSurface);
  SurfacePoint point;
  evaluateSurfaceProgram(&formula->program, kShapeOf, 0.6, 1.4, point);
  const std::string code = withShape(writeEvaluator(*formula, "evaluateOwn"));
  EXPECT_NE(code.find("[[maybe_unused]] double u, [[maybe_unused]] double v, SurfacePoint& p) noexcept {"), std::string::npos);
  const std::pair<const char*, Vec3> members[] = {{"r", point.r},     {"rU", point.rU},   {"rV", point.rV},
                                                  {"rUu", point.rUu}, {"rUv", point.rUv}, {"rVv", point.rVv}};
  for (const auto& [member, expected] : members)
    expectVector(runCpp(code, parts(behind(code, std::string("p.") + member + " = {", "};")), {"u", "v"}, {0.6, 1.4}), expected, member);
}

// Eq. (11): m |r'|^2 phi'' + lambda |r'|^2 phi' + m (r'.r'') phi'^2 = r'.f.
TEST(WrittenCode, OfACurvesDynamicsHasItsCoefficients) {
  const auto formula = compiled(ConstraintKind::Curve, kCurve);
  const std::string code = writeDynamicsCode(*formula, "own-curve", {0.25});
  EXPECT_EQ(code.find("#include <cmath>\n\n// own-curve: r(phi) = {a*cos(phi) + double, "), 0u) << code;
  EXPECT_NE(code.find("struct OwnCurveDynamics {\n  double x, y, z, M, L, V, Q;\n};\n"), std::string::npos) << code;
  EXPECT_NE(
      code.find(
          "inline OwnCurveDynamics computeOwnCurveDynamics([[maybe_unused]] double phi, [[maybe_unused]] double fx, "
          "[[maybe_unused]] double fy, [[maybe_unused]] double fz, [[maybe_unused]] double m, [[maybe_unused]] double lambda, double a "
          "= 0.25, double doubleShape) {\n  /*----- Curve coordinates"),
      std::string::npos)
      << code;
  EXPECT_NE(code.find("inline double signOf(double x)"), std::string::npos);
  EXPECT_EQ(writeDynamicsCode(*compiled(ConstraintKind::Curve, {"a*phi", "phi^2", "0"}), "x", {}).find("signOf"), std::string::npos);
  CurvePoint p;
  evaluateCurveProgram(&formula->program, kShapeOf, 1.7, p);
  const Vec3 f{1.1, -0.6, 2.3};
  const double m = 1.9, lambda = 0.4, square = dot(p.rPhi, p.rPhi);
  const std::pair<const char*, double> outputs[] = {{"x", p.r.x},         {"y", p.r.y},           {"z", p.r.z},
                                                    {"M", m * square},    {"L", lambda * square}, {"V", m * dot(p.rPhi, p.rPhiPhi)},
                                                    {"Q", dot(p.rPhi, f)}};
  for (const auto& [output, expected] : outputs)
    EXPECT_NEAR(runCpp(code.substr(code.find("-----*/")), {behind(code, std::string("out.") + output + " = ", ";")},
                       {"phi", "fx", "fy", "fz", "m", "lambda", "a", "doubleShape"}, {1.7, f.x, f.y, f.z, m, lambda, 0.7, 1.3})[0],
                expected, 1e-12 * (1 + std::abs(expected)))
        << output;
}

// Eq. (13): G = J'J, C = J' (r_uu u'^2 + 2 r_uv u'v' + r_vv v'^2), Q = J' f.
TEST(WrittenCode, OfASurfacesDynamicsHasItsCoefficients) {
  const auto formula = compiled(ConstraintKind::Surface, kSurface);
  const std::string code = writeDynamicsCode(*formula, "own-surface", {0.7, 1.3});
  EXPECT_NE(code.find("// own-surface: r(u, v) = {"), std::string::npos);
  EXPECT_NE(code.find("/*----- Surface coordinates and dynamic parameters -----*/\n"), std::string::npos);
  EXPECT_NE(code.find("[[maybe_unused]] double uRate, [[maybe_unused]] double vRate, double a = 0.7, double doubleShape = 1.3) {"),
            std::string::npos);
  SurfacePoint p;
  evaluateSurfaceProgram(&formula->program, kShapeOf, 0.6, 1.4, p);
  const Vec3 f{1.1, -0.6, 2.3};
  const double du = 0.8, dv = -1.7;
  const Vec3 w = du * du * p.rUu + 2 * du * dv * p.rUv + dv * dv * p.rVv;
  const std::pair<const char*, double> outputs[] = {
      {"y", p.r.y},         {"G11", dot(p.rU, p.rU)}, {"G12", dot(p.rU, p.rV)}, {"G22", dot(p.rV, p.rV)},
      {"C1", dot(p.rU, w)}, {"C2", dot(p.rV, w)},     {"Q1", dot(p.rU, f)},     {"Q2", dot(p.rV, f)}};
  for (const auto& [output, expected] : outputs)
    EXPECT_NEAR(runCpp(code.substr(code.find("-----*/")), {behind(code, std::string("out.") + output + " = ", ";")},
                       {"u", "v", "fx", "fy", "fz", "uRate", "vRate", "a", "doubleShape"}, {0.6, 1.4, f.x, f.y, f.z, du, dv, 0.7, 1.3})[0],
                expected, 1e-12 * (1 + std::abs(expected)))
        << output;
}

TEST(WrittenCode, HasNamesThatNobodyElseHas) {
  EXPECT_EQ(cppIdentifier("size", {}), "size");
  EXPECT_EQ(cppIdentifier("while", {}), "whileShape");
  EXPECT_EQ(cppIdentifier("size", {"size"}), "sizeShape");
  EXPECT_EQ(cppIdentifier("size", {"sizeShape", "size"}), "sizeShapeShape");
  EXPECT_EQ(cppIdentifier("_x", {}), "shape_x");
  EXPECT_EQ(cppIdentifier("a__b___c", {}), "shapea_b_c");
  EXPECT_EQ(cppIdentifier("a_b_c", {}), "a_b_c");
  const auto twoNames = compileFormula({ConstraintKind::Curve, {"double*phi", "doubleShape*phi", "0"}, {"double", "doubleShape"}}, "here");
  EXPECT_NE(writeEvaluator(*twoNames, "f").find("const double doubleShape = shape[0];\n  const double doubleShapeShape = shape[1];"),
            std::string::npos);
  EXPECT_EQ(upperCamel("spherical-spiral"), "SphericalSpiral");
  EXPECT_EQ(upperCamel("a-9z-zA"), "A9zZA");
  EXPECT_EQ(upperCamel(""), "");
  const auto formula =
      compileFormula({ConstraintKind::Curve, {"sinPhi*sin(phi)", "t1*sqrt(phi + 2)", "sqrt(phi + 2)"}, {"sinPhi", "t1"}}, "here");
  const std::string code = writeEvaluator(*formula, "f");
  EXPECT_NE(code.find("sinCos(phi, sinPhi_, cosPhi);"), std::string::npos) << code;
  EXPECT_EQ(code.find("const double t1 = std"), std::string::npos) << code;
  EXPECT_NE(code.find("const double t1_ = "), std::string::npos) << code;
}

}  // namespace
}  // namespace reachlab::constraints
