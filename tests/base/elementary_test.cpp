#include "base/math/elementary.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace reachlab {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
constexpr double kInf = std::numeric_limits<double>::infinity();

// The largest error of `ours` in units in the last place of the right result.
double worstUlps(double (*ours)(double), double lo, double hi, const std::function<Real(Real)>& right) {
  std::mt19937_64 chance(1);
  std::uniform_real_distribution<double> place(lo, hi);
  double worst = 0;
  for (int k = 0; k < 1000; ++k) {
    const double x = place(chance);
    const Real exact = right(Real(x));
    const double size = std::abs(static_cast<double>(exact));
    const double ulp = std::nextafter(size, kInf) - size;
    worst = std::max(worst, std::abs(static_cast<double>((Real(ours(x)) - exact) / Real(ulp))));
  }
  return worst;
}

TEST(Elementary, IsRightToOneUnitInTheLastPlace) {
  EXPECT_LT(worstUlps(elementary::exp, -700, 700, [](Real x) { return exp(x); }), 1);
  EXPECT_LT(worstUlps(elementary::exp, -1, 1, [](Real x) { return exp(x); }), 1);
  EXPECT_LT(worstUlps(elementary::log, 0.5, 2, [](Real x) { return log(x); }), 1);
  EXPECT_LT(worstUlps(elementary::log, 1e-9, 1e9, [](Real x) { return log(x); }), 1);
  EXPECT_LT(worstUlps([](double x) { return elementary::pow(x, 1.7); }, 0, 30, [](Real x) { return pow(x, Real(1.7)); }), 1);
  EXPECT_LT(worstUlps(elementary::sin, 1e5, 1e9, [](Real x) { return sin(x); }), 1);
  EXPECT_LT(worstUlps(elementary::cos, -1e9, -1e5, [](Real x) { return cos(x); }), 1);
  EXPECT_LT(worstUlps(elementary::tan, -1e4, 1e4, [](Real x) { return tan(x); }), 1);
  EXPECT_LT(worstUlps(elementary::asin, -1, 1, [](Real x) { return asin(x); }), 1);
  EXPECT_LT(worstUlps(elementary::acos, -1, 1, [](Real x) { return acos(x); }), 1);
  EXPECT_LT(worstUlps(elementary::atan, -20, 20, [](Real x) { return atan(x); }), 1);
  EXPECT_LT(worstUlps(elementary::sinh, -20, 20, [](Real x) { return sinh(x); }), 1);
  EXPECT_LT(worstUlps(elementary::cosh, -20, 20, [](Real x) { return cosh(x); }), 1);
  EXPECT_LT(worstUlps(elementary::tanh, -5, 5, [](Real x) { return tanh(x); }), 1);
}

// A formula's domain ends where the C library's does: the same signs, infinities and not-a-numbers.
TEST(Elementary, EndsWhereTheCLibraryDoes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double places[] = {0.0, -0.0, 0.5, -0.5, 1, -1, 2, -2, 3, -3, 700, -700, 800, -800, 1e300, -1e300, kInf, -kInf, nan};
  const auto same = [](double ours, double theirs) {
    if (std::isnan(theirs)) return std::isnan(ours);
    if (theirs == 0 || std::isinf(theirs)) return ours == theirs && std::signbit(ours) == std::signbit(theirs);
    return std::abs(ours - theirs) <= 4.5e-16 * std::abs(theirs);
  };
  struct Pair {
    const char* name;
    double (*ours)(double);
    double (*theirs)(double);
  };
  const Pair pairs[] = {{"sin", elementary::sin, std::sin},    {"cos", elementary::cos, std::cos},    {"exp", elementary::exp, std::exp},
                        {"log", elementary::log, std::log},    {"tan", elementary::tan, std::tan},    {"asin", elementary::asin, std::asin},
                        {"acos", elementary::acos, std::acos}, {"atan", elementary::atan, std::atan}, {"sinh", elementary::sinh, std::sinh},
                        {"cosh", elementary::cosh, std::cosh}, {"tanh", elementary::tanh, std::tanh}};
  for (const double x : places) {
    for (const Pair& pair : pairs) EXPECT_PRED2(same, pair.ours(x), pair.theirs(x)) << pair.name << " of " << x;
    for (const double y : places) {
      EXPECT_PRED2(same, elementary::pow(x, y), std::pow(x, y)) << x << " to the " << y;
      EXPECT_PRED2(same, elementary::atan2(x, y), std::atan2(x, y)) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace reachlab
