#include "constraints/period.h"

#include <gtest/gtest.h>

#include <numbers>

#include "constraints/constraint.h"

namespace reachlab::constraints {
namespace {

// The sum of terms that turn at different paces closes when all have come round; one that stands still is never waited for.
TEST(Period, IsTheShortestThatClosesEveryTerm) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (const auto& [k, turns] : {std::pair{0.0, 1.0}, {1.0, 1.0}, {3.0, 1.0}, {0.5, 2.0}, {1.5, 2.0}, {0.25, 4.0}}) {
    const Constraint c =
        makeConstraint({.name = {}, .curve = {"cos(phi)", "sin(phi)", "0.1*cos(k*phi)"}, .surface = {}, .shape = {{"k", k}}});
    EXPECT_NEAR(findPeriod(c).turn, turns * kTurn, 1e-12) << k;
  }
  EXPECT_EQ(findPeriod(makeConstraint({.name = {}, .curve = {"cos(phi)", "sin(phi)", "phi"}, .surface = {}, .shape = {}})).turn, 0);
}

}  // namespace
}  // namespace reachlab::constraints
