#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/fault.h"
#include "constraints/constraint.h"

namespace reachlab::constraints {
namespace {

constexpr double kRounding = 1e-15;  // a few roundings of numbers below 1

TEST(TypedFormula, EllipseGivesItsDerivatives) {
  const Constraint c =
      makeConstraint({.name = "", .curve = {"0", "a*cos(phi)", "b*sin(phi)"}, .surface = {}, .shape = {{"a", 0.1}, {"b", 0.06}}});
  for (const double phi : {-20.0, -1.0, 0.0, 0.3, 2.0, 1e4, 3e6}) {
    const CurvePoint p = evaluate(c.curve, phi);
    EXPECT_NEAR(p.r.y, 0.1 * std::cos(phi), kRounding);
    EXPECT_NEAR(p.rPhi.y, -0.1 * std::sin(phi), kRounding);
    EXPECT_NEAR(p.rPhiPhi.z, -0.06 * std::sin(phi), kRounding);
    EXPECT_EQ(p.rPhiPhi.x, 0);
  }
  EXPECT_FALSE(c.straight);
}

TEST(TypedFormula, MonkeySaddleGivesItsDerivatives) {
  const Constraint c = makeConstraint({.name = "", .curve = {}, .surface = {"u/10", "v/10", "(u^3 - 3*u*v^2)/50"}, .shape = {}});
  const double u = -0.95, v = 0.3;
  const SurfacePoint p = evaluate(c.surface, u, v);
  EXPECT_NEAR(p.r.z, (u * u * u - 3 * u * v * v) / 50, kRounding);
  EXPECT_NEAR(p.rU.z, (3 * u * u - 3 * v * v) / 50, kRounding);
  EXPECT_NEAR(p.rUv.z, -6 * v / 50, kRounding);
  EXPECT_NEAR(p.rVv.z, -6 * u / 50, kRounding);
  EXPECT_NEAR(p.rU.x, 0.1, kRounding);
}

// 0*log(phi) is 0 where it has a value, and it has none below 0: simplified to 0 it would go on there without a word.
TEST(TypedFormula, WhatCancelsOutWithTheEndOfItsDomainIsRefused) {
  const auto faultOf = [](const std::string& y) -> std::string {
    try {
      makeConstraint({.name = "", .curve = {"phi/10", y, "phi/5"}, .surface = {}, .shape = {}});
      return {};
    } catch (const FaultError& fault) {
      return fault.faults.at(0).key + ": " + fault.faults.at(0).what;
    }
  };
  EXPECT_EQ(faultOf("0*log(phi)").find("constraint.curve[1]: log(phi) cancels out"), 0u) << faultOf("0*log(phi)");
  for (const char* y : {"0*sqrt(phi)", "log(phi) - log(phi)", "asin(phi)/asin(phi)", "0*acos(phi)", "0*phi^0.3", "log(phi)^0"})
    EXPECT_NE(faultOf(y).find("cancels out"), std::string::npos) << y;
  for (const char* y :
       {"0*sin(phi)", "0*log(1 + phi^2)", "sqrt(1 + phi^2)^2", "0*exp(phi)", "sqrt(phi)*sqrt(phi)", "2*log(phi + 9) - log(phi + 9)"})
    EXPECT_EQ(faultOf(y), "") << y;
}

TEST(Line, RunsFromMinusToPlusHalfItsLength) {
  const Constraint c = makeConstraint({});
  EXPECT_TRUE(c.straight);
  EXPECT_NEAR(evaluate(c.curve, 0).r.x, -0.1, kRounding);
  EXPECT_NEAR(evaluate(c.curve, 2 * std::numbers::pi).r.x, 0.1, kRounding);
  EXPECT_NEAR(evaluate(c.curve, 1).rPhi.x, 0.2 / (2 * std::numbers::pi), kRounding);
}

}  // namespace
}  // namespace reachlab::constraints
