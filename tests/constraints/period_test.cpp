#include "constraints/regularity/period.h"

#include <gtest/gtest.h>

#include <numbers>

#include "constraints/constraint.h"
#include "tests/constraints/made_constraints.h"

namespace reachlab::constraints {
namespace {

// The sum of terms that turn at different paces closes when all have come round; one that stands still is never waited for.
TEST(Period, IsTheShortestThatClosesEveryTerm) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (const auto& [k, turns] : {std::pair{0.0, 1.0}, {1.0, 1.0}, {3.0, 1.0}, {0.5, 2.0}, {1.5, 2.0}, {0.25, 4.0}}) {
    const Constraint c = curve({"cos(phi)", "sin(phi)", "0.1*cos(k*phi)"}, {{"k", k}});
    EXPECT_NEAR(findPeriod(c).turn, turns * kTurn, 1e-12) << k;
  }
  EXPECT_EQ(findPeriod(curve({"cos(phi)", "sin(phi)", "phi"})).turn, 0);
}

Period periodOf(const std::string& wave, const std::map<std::string, double>& shape = {}) {
  return findPeriod(curve({"cos(3*phi)", "sin(3*phi)", wave}, shape));
}

// A third of a turn beside what each stands for: the angle is a phi + b however it is written.
TEST(Period, KnowsAnAngleHoweverItIsWritten) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (const char* third :
       {"sin(6*phi)", "sin(phi*6)", "sin(2*phi + phi)", "sin(9*phi - 3*phi)", "cos(-(3*phi))", "cos(1 + 6*phi)", "sin(12*phi/2)",
        "tan(3*phi)", "sin(3*phi)^2 + 1", "exp(cos(3*phi))", "atan2(sin(3*phi), 2 + cos(3*phi))", "sin(3*(phi + 2))"})
    EXPECT_NEAR(periodOf(third).turn, kTurn / 3, 1e-15) << third;
  EXPECT_NEAR(periodOf("sin(a*phi)", {{"a", 2}}).turn, kTurn, 1e-15);
  EXPECT_NEAR(periodOf("sin(phi*a)", {{"a", 2}}).turn, kTurn, 1e-15);
  EXPECT_NEAR(periodOf("sin(phi/a)", {{"a", 2}}).turn, 2 * kTurn, 1e-15);
  EXPECT_NEAR(periodOf("sin(2*phi - a*phi)", {{"a", 0.5}}).turn, 2 * kTurn / 3, 1e-14);
  for (const char* none : {"phi", "sin(phi^2)", "sin(1/phi)", "sin(phi*phi)", "sin(sin(phi) + phi)", "phi*sin(phi)", "exp(phi)",
                           "sin(abs(phi))", "atan2(1, phi)"})
    EXPECT_EQ(periodOf(none).turn, 0) << none;
}

TEST(Period, IsNoneWhereItWouldBeTooLong) {
  constexpr double kTurn = 2 * std::numbers::pi;
  EXPECT_NEAR(periodOf("sin(3*phi/64)").turn, 64 * kTurn / 3, 1e-12);
  EXPECT_NEAR(periodOf("sin(189*phi/64)").turn, 64 * kTurn / 3, 1e-12) << "64 of the slowest turns at most, which this is";
  EXPECT_EQ(periodOf("sin(sqrt(2)*phi)").turn, 0);
  EXPECT_EQ(periodOf("sin(3*phi*66/65)").turn, 0) << "65 of the slowest";
  EXPECT_EQ(findPeriod(named("free")).turn, 0);
  EXPECT_EQ(findPeriod(named("sphere")).turn, 0);
}

// 2 pi is 6.283185307179586 + 2.4492935982947064e-16.
TEST(Period, HasTheDigitsThatADoubleHasNotRoomFor) {
  const Period period = findPeriod(curve({"cos(phi)", "sin(phi)", "0"}));
  EXPECT_EQ(period.turn, 6.283185307179586);
  EXPECT_NEAR(period.rest, 2.4492935982947064e-16, 5e-19) << "as far as a long double knows it";
}

}  // namespace
}  // namespace reachlab::constraints
