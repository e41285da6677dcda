#include "sim/dynamics/systems/polar_chart.h"

#include <gtest/gtest.h>

#include "constraints/regularity/analysis.h"
#include "sim/dynamics/systems/surface_rates.h"

namespace reachlab::dynamics {
namespace {

constexpr double kPole = 0.4;

/// A smooth cap F(xi, eta) with nothing symmetric, written by angle and distance from its pole at kPole of the other parameter.
constraints::Constraint cap(int fixed, double side) {
  const std::string angle = fixed == 1 ? "u" : "v",
                    radius = side > 0 ? (fixed == 1 ? "(v-0.4)" : "(u-0.4)") : (fixed == 1 ? "(0.4-v)" : "(0.4-u)");
  const std::string xi = radius + "*cos(" + angle + ")", eta = radius + "*sin(" + angle + ")";
  return constraints::makeConstraint({.name = "",
                                      .curve = {},
                                      .surface = {xi + "+0.3*" + xi + "*" + eta, "0.8*" + eta + "+0.1*(" + xi + ")^2",
                                                  "0.5*(" + xi + ")^2-0.2*(" + eta + ")^2+0.05*" + xi + "*" + eta + "+0.3*" + eta},
                                      .shape = {}});
}
constraints::SurfacePoint truth(double x, double y) {
  constraints::SurfacePoint p;
  p.r = {x + 0.3 * x * y, 0.8 * y + 0.1 * x * x, 0.5 * x * x - 0.2 * y * y + 0.05 * x * y + 0.3 * y};
  p.rU = {1 + 0.3 * y, 0.2 * x, x + 0.05 * y};
  p.rV = {0.3 * x, 0.8, 0.3 - 0.4 * y + 0.05 * x};
  p.rUu = {0, 0.2, 1};
  p.rUv = {0.3, 0, 0.05};
  p.rVv = {0, 0, -0.4};
  return p;
}

struct Way {
  int fixed;
  double side;
};
constexpr Way kWays[] = {{0, 1}, {0, -1}, {1, 1}, {1, -1}};

TEST(PolarChart, IsTheSmoothSurfaceAboutThePole) {
  for (const auto& [fixed, side] : kWays) {
    const constraints::Constraint c = cap(fixed, side);
    const PolarChart chart{c.surface, fixed, kPole, side};
    for (const auto& [x, y] : {std::pair{0.2, 0.1}, {-0.1, 0.3}, {-0.25, -0.05}, {0.07, -0.2}, {0.01, 0.0}}) {
      SCOPED_TRACE(testing::Message() << fixed << " " << side << ": " << x << ", " << y);
      const constraints::SurfacePoint p = constraints::evaluate(chart.surface(), x, y), f = truth(x, y);
      EXPECT_LT(norm(p.r - f.r), 1e-15);
      EXPECT_LT(norm(p.rU - f.rU), 1e-13);
      EXPECT_LT(norm(p.rV - f.rV), 1e-13);
      EXPECT_LT(norm(p.rUu - f.rUu), 1e-10);
      EXPECT_LT(norm(p.rUv - f.rUv), 1e-10);
      EXPECT_LT(norm(p.rVv - f.rVv), 1e-10);
    }
  }
}

// Whatever the two parameter lines are like, the rates give the velocity back; where one of them stands still the other carries it.
TEST(SurfaceRates, AreThoseWhoseVelocityItIs) {
  constraints::SurfacePoint p;
  p.rU = {0.3, 0.1, -0.2}, p.rV = {0.25, -0.4, 0.1};
  const std::array<double, 2> rates = solveRates(p, 1.7 * p.rU - 0.6 * p.rV);
  EXPECT_NEAR(rates[0], 1.7, 1e-14);
  EXPECT_NEAR(rates[1], -0.6, 1e-14);
  const Vec3 out = cross(p.rU, p.rV);
  EXPECT_NEAR(solveRates(p, 1.7 * p.rU - 0.6 * p.rV + out)[0], 1.7, 1e-14) << "what leaves the surface is not asked for";
  constraints::SurfacePoint pole = p;
  pole.rV = {};
  EXPECT_NEAR(solveRates(pole, 1.7 * p.rU)[0], 1.7, 1e-14);
  EXPECT_EQ(solveRates(pole, 1.7 * p.rU)[1], 0);
  pole = p, pole.rU = {};
  EXPECT_NEAR(solveRates(pole, -0.6 * p.rV)[1], -0.6, 1e-14);
  EXPECT_EQ(solveRates(pole, -0.6 * p.rV)[0], 0);
  pole.rV = {};
  EXPECT_EQ(solveRates(pole, p.rU), (std::array{0.0, 0.0})) << "where nothing moves";
  // Of parallel lines the longer carries all.
  pole.rU = {2, 0, 0}, pole.rV = {1, 0.5e-12, 0};
  EXPECT_EQ(solveRates(pole, {3, 0, 0}), (std::array{1.5, 0.0}));
  pole.rU = {1, 0.5e-12, 0}, pole.rV = {2, 0, 0};
  EXPECT_EQ(solveRates(pole, {3, 0, 0}), (std::array{0.0, 1.5}));
  pole.rU = {2, 0, 0}, pole.rV = {1, 1e-6, 0};
  EXPECT_NEAR(solveRates(pole, {1, 1e-6, 0})[1], 1, 1e-3) << "a second direction, if only just";
}

}  // namespace
}  // namespace reachlab::dynamics
