#include "constraints/rounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "constraints/analysis.h"

namespace reachlab::constraints {
namespace {

// Beside long double the double is never farther off than told, and nearly half of it at worst: numbers just below 1 are rounded by half as
// much as those just above. Near the end of its domain an arc cosine or sine makes that many times greater.
TEST(Rounding, OfArcsNearTheirEndsIsToldAsItIs) {
  for (const char* arc : {"acos", "asin"}) {
    const Constraint c = makeConstraint({.name = {}, .curve = {"phi", std::string(arc) + "(1 - phi)", "0"}, .surface = {}, .shape = {}});
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

}  // namespace
}  // namespace reachlab::constraints
