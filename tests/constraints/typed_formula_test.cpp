#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/fault.h"
#include "constraints/constraint.h"
#include "tests/refusal.h"
#include "tests/constraints/made_constraints.h"

namespace reachlab::constraints {
namespace {

// 0*log(phi) is 0 where it has a value, and it has none below 0: simplified to 0 it would go on there without a word.
TEST(TypedFormula, WhatCancelsOutWithTheEndOfItsDomainIsRefused) {
  const auto faultOf = [](const std::string& y) -> std::string {
    const std::vector<Fault> faults = faultsToldBy([&] { curve({"phi/10", y, "phi/5"}); });
    return faults.empty() ? "" : faults[0].key + ": " + faults[0].what;
  };
  EXPECT_EQ(faultOf("0*log(phi)").find("constraint.curve[1]: log(phi) cancels out"), 0u) << faultOf("0*log(phi)");
  for (const char* y : {"0*sqrt(phi)", "log(phi) - log(phi)", "asin(phi)/asin(phi)", "0*acos(phi)", "0*phi^0.3", "log(phi)^0"})
    EXPECT_TRUE(holds(faultOf(y), "cancels out")) << y;
  for (const char* y :
       {"0*sin(phi)", "0*log(1 + phi^2)", "sqrt(1 + phi^2)^2", "0*exp(phi)", "sqrt(phi)*sqrt(phi)", "2*log(phi + 9) - log(phi + 9)"})
    EXPECT_EQ(faultOf(y), "") << y;
}

TEST(Line, RunsFromMinusToPlusHalfItsLength) {
  const Constraint c = makeConstraint(ConstraintSpec{});
  EXPECT_TRUE(c.straight);
  EXPECT_NEAR(evaluate(c.curve, 0).r.x, -0.1, kRounding);
  EXPECT_NEAR(evaluate(c.curve, 2 * std::numbers::pi).r.x, 0.1, kRounding);
  EXPECT_NEAR(evaluate(c.curve, 1).rPhi.x, 0.2 / (2 * std::numbers::pi), kRounding);
}

}  // namespace
}  // namespace reachlab::constraints
