#include <gtest/gtest.h>

#include <cmath>

#include "constraints/formula/formula.h"
#include "constraints/formula/interval_series.h"

namespace reachlab::constraints {
namespace {

/// The bound of the coefficient of s^8 over [at - half, at + half] along s = phi.
double boundOf(const std::string& x, double at, double half) {
  const auto formula = compileFormula({ConstraintKind::Curve, {x, "0", "0"}, {}}, "curve");
  const std::vector<int> r(formula->roots.begin(), formula->roots.begin() + 1);
  IntervalSeries series(formula->graph, r, nullptr);
  return series.bound({Interval{at - half, at + half}, Interval{}}, {Interval{1, 1}, Interval{}});
}

struct Known {
  const char* x;
  double at, value;  // of the eighth derivative over 8!, by 40 digits
};

// At a point a bound is the number itself, and over a box it is no less at any place of it.
TEST(IntervalSeries, BoundsTheEighthDerivativeOfEveryFunction) {
  constexpr Known kKnown[] = {
      {"sin(3*phi)", 0.4, 0.15166439590850626},
      {"cos(phi)^3", 0.4, 0.014758137463439134},
      {"tan(phi)", 0.3, 0.11213402274195412},
      {"asin(phi)", 0.3, 0.26279050419814511},
      {"acos(phi)", 0.3, -0.26279050419814511},
      {"atan(2*phi)", 0.3, -8.6549741029047345},
      {"atan2(phi, 1 + phi^2)", 0.3, -1.1514691751345701},
      {"sinh(phi)", 0.3, 7.5525866430342909e-6},
      {"cosh(2*phi)", 0.3, 0.0075267632904270964},
      {"tanh(3*phi)", 0.3, -62.785257633250486},
      {"exp(-phi^2)", 0.3, 0.013071302671877202},
      {"log(1 + phi)", 0.3, -0.015323684248003209},
      {"sqrt(1 + phi^2)", 0.3, 0.015975393628448908},
      {"(1 + phi)^2.5", 0.3, -0.00032439499212110141},
      {"(2 + phi)^phi", 0.3, 0.0055709742955068977},
      {"phi^9 - phi", 0.3, 2.6999999999999999},
      {"phi/(2 + phi)", 0.3, -0.0011104000470318184},
      {"(2 + phi)^-3", 0.3, 0.0047228735459765433},
      {"abs(sin(phi) - 2)", 0.3, -7.3293702048943344e-6},
  };
  for (const auto& [x, at, value] : kKnown) {
    SCOPED_TRACE(x);
    EXPECT_NEAR(boundOf(x, at, 0), std::abs(value), 1e-9 * std::abs(value));
    EXPECT_GE(boundOf(x, at + 0.01, 0.02) * (1 + 1e-12), std::abs(value));
    EXPECT_GE(boundOf(x, at - 0.01, 0.02) * (1 + 1e-12), std::abs(value));
    EXPECT_LT(boundOf(x, at, 1e-9), std::abs(value) * (1 + 1e-4)) << "and hardly more over a short one";
  }
}

TEST(IntervalSeries, IsUnboundedOnlyWhereAFormulaIs) {
  for (const char* x : {"1/phi", "sqrt(phi)", "log(phi)", "tan(phi + 1.5)", "asin(phi + 1)", "phi^2.5", "phi^-1"})
    EXPECT_TRUE(std::isinf(boundOf(x, 0, 0.1))) << x;
  EXPECT_EQ(boundOf("3*phi^7 - phi^2", 0.3, 5), 0);
  EXPECT_EQ(boundOf("tanh(1e5*phi)", 0.3, 0.1), 0) << "flat, and no rounding shows";
  EXPECT_EQ(boundOf("exp(-(1e4*phi)^2)", 0.3, 0.1), 0);
  EXPECT_TRUE(std::isfinite(boundOf("abs(sin(phi))", 0, 0.1))) << "both sides of a kink";
  EXPECT_GE(boundOf("abs(sin(phi))", 0, 0.1), 0);
}

}  // namespace
}  // namespace reachlab::constraints
