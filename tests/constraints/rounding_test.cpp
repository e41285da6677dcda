#include "constraints/constraint.h"
#include "constraints/regularity/rounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "constraints/regularity/analysis.h"
#include "tests/constraints/made_constraints.h"

namespace reachlab::constraints {
namespace {

// Beside long double the double is never farther off than told, and nearly half of it at worst: numbers just below 1 are rounded by half as
// much as those just above. Near the end of its domain an arc cosine or sine makes that many times greater.
TEST(Rounding, OfArcsNearTheirEndsIsToldAsItIs) {
  for (const char* arc : {"acos", "asin"}) {
    const Constraint c = curve({"phi", std::string(arc) + "(1 - phi)", "0"});
    for (const double place : {1e-10, 1e-6, 1e-4}) {
      double worst = 0, told = 0;
      for (int i = 0; i < 400; ++i) {
        const double phi = place * (1 + i / 400.0);
        const long double x = 1 - static_cast<long double>(phi);
        const long double exact = std::string(arc) == "acos" ? std::acos(x) : std::asin(x);
        const auto off = static_cast<double>(std::abs(static_cast<long double>(evaluate(c.curve, phi).r.y) - exact));
        told = computeRounding(c, phi);
        EXPECT_LE(off, 1.01 * told) << arc << " at " << phi;
        worst = std::max(worst, off);
      }
      EXPECT_GT(worst, 0.4 * told) << arc << " near " << place;
    }
  }
}

// The angle of a point turns by what its coordinates are off across it, over their distance from the origin: here 1e6 roundings of y and none
// of x, and the other way round.
TEST(Rounding, OfAnAngleIsThatOfThePointAcrossIt) {
  const auto told = [](const std::string& y) { return computeRounding(curve({"0", y, "0"}, {{"c", 1e6}}), 0.3); };
  const double off = told("(c + phi) - c");
  for (const double x : {0.25, 4.0}) {
    const std::string far = std::to_string(x);
    EXPECT_NEAR(told("atan2((c + phi) - c, " + far + ")"), off * x / (x * x + 0.09), 1e-3 * off) << far;
    EXPECT_NEAR(told("atan2(" + far + ", (c + phi) - c)"), off * x / (x * x + 0.09), 1e-3 * off) << far;
  }
}

// What is exact hands no error on, also where a function is steepest.
TEST(Rounding, OfAnExactNumberIsNone) {
  const auto told = [](const std::string& y) {
    std::map<std::string, double> shape{{"c", 1e6}, {"a", 0}, {"b", 1}};
    std::erase_if(shape, [&](const auto& one) { return y.find("(" + one.first) == std::string::npos; });
    return computeRounding(curve({"phi", y, "0"}, shape), 0.3);
  };
  const double alone = told("(c + phi) - c");
  EXPECT_NEAR(alone, 1e6 * 0x1p-53, 1e-3 * alone);
  for (const char* exact : {"sqrt(a)", "acos(b)", "asin(b)", "(a)*(b)", "(a)/(b)", "(a)^(b)"})
    EXPECT_NEAR(told("(c + phi) - c + " + std::string(exact)), alone, 1e-3 * alone) << exact;
}

// A sign changed or taken off rounds nothing: the number is off by what it was off by before.
TEST(Rounding, ASignCostsNothing) {
  const auto told = [](const std::string& y) { return computeRounding(curve({"phi", y, "0"}), 0.3); };
  for (const char* sign : {"-sqrt(phi + 1)", "abs(sqrt(phi + 1))"}) EXPECT_EQ(told(sign), told("sqrt(phi + 1)")) << sign;
}

}  // namespace
}  // namespace reachlab::constraints
