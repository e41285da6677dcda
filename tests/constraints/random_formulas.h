#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "constraints/formula/expression.h"
#include "constraints/formula/formula.h"
#include "constraints/formula/parser.h"

/// Seeded random formulas, each with the same formula reckoned as it is written.
namespace reachlab::constraints {

constexpr double kShape[] = {0.7, -1.3};

/// A number with its two partial derivatives, by the rules of differentials. Rough: at a place where rounding would be magnified.
struct Dual {
  double x = 0, du = 0, dv = 0, size = 0;
  bool rough = false;
};
inline Dual chained(const Dual& a, const Dual& b, double x, double da, double db, bool rough = false) {
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

inline Term unary(
    const std::string& before, const std::string& after, const Term& a, double (*f)(double), double (*rate)(double),
    bool (*rough)(double) = [](double) { return false; }) {
  return {before + a.text + after, [=](double u, double v) {
            const Dual x = a.at(u, v);
            return chained(x, {}, f(x.x), rate(x.x), 0, rough(x.x));
          }};
}
inline Term binary(char sign, const Term& a, const Term& b) {
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
inline Term powered(const Term& a, int n) {
  return {"((" + a.text + ")^(" + std::to_string(n) + "))", [=](double u, double v) {
            const Dual x = a.at(u, v);
            return chained(x, {}, std::pow(x.x, n), n == 0 ? 0 : n * std::pow(x.x, n - 1), 0, n < 0 && !(std::abs(x.x) > 0.1));
          }};
}
inline Term turned(const Term& a, const Term& b) {
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

inline const std::vector<std::string> kVariables{"u", "v"}, kParameters{"a", "b"};
constexpr std::array<double, 2> kPlaces[] = {{0.37, 1.21}, {-0.83, 0.45}, {1.9, -1.4}};

inline int nodeOf(ExpressionGraph& graph, const std::string& text, const std::vector<std::string>& variables = kVariables,
                  const std::vector<std::string>& parameters = kParameters) {
  const ParsedFormula parsed = parseFormula(text, {variables, parameters}, graph);
  EXPECT_FALSE(parsed.fault) << text;
  return parsed.root;
}
inline double valueOf(const ExpressionGraph& graph, int root, const std::array<double, 2>& at) {
  return evaluateNodes(graph, std::array{root}, kShape, at.data())[0];
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

}  // namespace reachlab::constraints
