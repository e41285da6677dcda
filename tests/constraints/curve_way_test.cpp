#include "constraints/constraint.h"
#include "constraints/geometry/curve_way.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/fault.h"
#include "tests/refusal.h"
#include "tests/constraints/made_constraints.h"

namespace reachlab::constraints {
namespace {

// The catenary's arc from its lowest place is a sinh(phi), whose inverse is known; to 1e-12 of the whole as ArcLength says.
class CatenaryWay : public testing::TestWithParam<std::pair<double, double>> {
 protected:
  static double arcAt(double phi) { return kScale * std::sinh(phi); }
  static constexpr double kScale = 0.08;  // [m]
  const Constraint catenary = named("catenary", {{"a_m", kScale}});
};

TEST_P(CatenaryWay, IsMetresOfItsArcBothWays) {
  const auto [from, to] = GetParam();
  const CurveWay way(catenary, from, to);
  EXPECT_NEAR(way.length(), std::abs(arcAt(to) - arcAt(from)), 1e-12);
  EXPECT_EQ(way.sense(), to > from ? 1 : -1);
  for (const double share : {0.0, 0.3, 0.8, 1.0}) {
    const double s = share * way.length(), phi = std::asinh((arcAt(from) + way.sense() * s) / kScale);
    EXPECT_NEAR(way.parameterAt(s), phi, 1e-11) << s;
    EXPECT_NEAR(norm(way.at(s).r - evaluate(catenary.curve, phi).r), 0, 1e-12) << s;
    EXPECT_EQ(way.beyond(phi), 0) << s;
  }
}

// |r'| = a cosh(phi): so many metres per unit of the parameter, and from the end on always as many.
TEST_P(CatenaryWay, GoesOnBeyondItsEndsAtTheirPace) {
  const auto [from, to] = GetParam();
  const CurveWay way(catenary, from, to);
  constexpr double kPast = 0.03;  // [m]
  const double before = from - way.sense() * kPast / (kScale * std::cosh(from)),
               after = to + way.sense() * kPast / (kScale * std::cosh(to));
  EXPECT_NEAR(way.parameterAt(-kPast), before, 1e-11);
  EXPECT_NEAR(way.parameterAt(way.length() + kPast), after, 1e-11);
  EXPECT_NEAR(way.beyond(before), -kPast, 1e-12);
  EXPECT_NEAR(way.beyond(after), kPast, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Ends, CatenaryWay, testing::Values(std::pair{-0.4, 0.9}, std::pair{0.7, -0.6}));

TEST(CurveWay, FromAPlaceToItselfIsRefused) {
  const Constraint circle = named("circle");
  const std::vector<Fault> faults = faultsToldBy([&] { CurveWay(circle, 0.4, 0.4); });
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].key, "task.target");
}

}  // namespace
}  // namespace reachlab::constraints
