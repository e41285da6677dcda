#include "constraints/constraint.h"
#include "sim/dynamics/systems/quadric.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/constraints/made_constraints.h"

namespace reachlab::dynamics {
namespace {

// Ten coefficients found to 1e-15 of a surface of 0.1 m.
constexpr double kOffSurface = 1e-15;  // [m]

constraints::Surface surfaceOf(constraints::SurfaceFunction function) { return {function, nullptr, {}}; }
constraints::Surface sphere() {
  return surfaceOf([](const void*, const double*, double u, double v, constraints::SurfacePoint& p) noexcept {
    p.r = {0.1 * std::sin(v) * std::cos(u), 0.1 * std::sin(v) * std::sin(u), 0.1 * std::cos(v)};
  });
}
constraints::Surface ellipsoid() {
  return surfaceOf([](const void*, const double*, double u, double v, constraints::SurfacePoint& p) noexcept {
    p.r = {0.2 + 0.1 * std::sin(v) * std::cos(u), 0.07 * std::sin(v) * std::sin(u) - 0.1, 0.04 * std::cos(v)};
  });
}
const std::array<constraints::Domain, 2> kAnywhere{};
const std::array<constraints::Domain, 2> kRound{constraints::Domain{0, 2 * std::numbers::pi, true},
                                                constraints::Domain{0, std::numbers::pi, false}};

TEST(Quadric, KnowsASphereWithItsMiddleAndRadiusFromEveryOtherForm) {
  const std::optional<Quadric> round = fitQuadric(sphere(), kRound, {0, 1}), oblong = fitQuadric(ellipsoid(), kAnywhere, {0.4, 1.2});
  ASSERT_TRUE(round && oblong);
  const std::optional<Sphere> ball = sphereOf(*round);
  ASSERT_TRUE(ball);
  EXPECT_LT(norm(ball->middle), 1e-15);
  EXPECT_NEAR(ball->radius, 0.1, 1e-15);
  EXPECT_FALSE(sphereOf(*oblong));
  Quadric tilted = *round;  // only a product tells this one
  tilted.a[5] = 0.1 * tilted.a[0];
  EXPECT_FALSE(sphereOf(tilted));
}

TEST(Quadric, ItsGradientIsTheSlopeOfItsValueAndOfOrderOne) {
  const std::optional<Quadric> q = fitQuadric(ellipsoid(), kRound, {0.4, 1.2});
  ASSERT_TRUE(q);
  double sum = 0;
  int places = 0;
  for (double u = 0.05; u < 6; u += 0.31)
    for (double v = 0.1; v < 3; v += 0.17, ++places) {
      const Vec3 r = constraints::evaluate(ellipsoid(), u, v).r, n = q->gradient(r);
      for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        Vec3 up = r, down = r;
        up.*axis += 1e-3, down.*axis -= 1e-3;
        EXPECT_NEAR((q->value(up) - q->value(down)) / 2e-3, n.*axis, 1e-12);
      }
      sum += norm(n);
    }
  EXPECT_NEAR(sum / places, 1, 0.1);
  EXPECT_LT(norm(q->centre - Vec3{0.2, -0.1, 0}), 0.02);
}

/// The quadric of a typed surface, over the whole plane.
std::optional<Quadric> fitted(const constraints::Constraint& c) { return fitQuadric(c.surface, c.domain, {0.3, 0.2}); }

TEST(Quadric, IsProvedOfEveryFormOfSecondDegree) {
  for (const auto& [x, y, z] : {std::tuple{"0.1*cos(u)*cos(v)", "0.08*sin(u)*cos(v)", "0.06*sin(v)"},
                                {"0.3+0.1*cos(u)*cos(v)", "0.1*sin(u)*cos(v)-0.2", "0.1*sin(v)"},
                                {"0.1*u", "0.1*v", "0.05*(u^2 + v^2)"},
                                {"0.1*u + 0.05*v", "0.1*v + 0.3", "0.05*u*v + 0.02*u"},
                                {"0.1*cos(u)", "0.07*sin(u) + 0.02*cos(u)", "0.1*v"},
                                {"0.1*cos(u)*cos(v) + 0.03*sin(v)", "0.08*sin(u)*cos(v) + 0.02*sin(v)", "0.06*sin(v) + 0.01*cos(u)*cos(v)"},
                                {"v*cos(u)/10", "v*sin(u)/10", "v/10"},
                                {"0.1*cosh(v)*cos(u)", "0.1*cosh(v)*sin(u)", "0.1*sinh(v)"}}) {
    const constraints::Constraint c = constraints::surface({x, y, z});
    const std::optional<Quadric> q = fitted(c);
    ASSERT_TRUE(q) << z;
    EXPECT_TRUE(provesQuadric(c, *q)) << x << ", " << y << ", " << z;
    for (std::size_t k = 0; k < 6; ++k) {
      Quadric off = *q;
      off.a[k] += 1e-6;
      EXPECT_FALSE(provesQuadric(c, off)) << x << ", " << y << ", " << z << ": another coefficient " << k;
    }
    for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      Quadric off = *q;
      off.b.*axis += 1e-6;
      EXPECT_FALSE(provesQuadric(c, off));
    }
    Quadric off = *q;
    off.c += 1e-8;
    EXPECT_FALSE(provesQuadric(c, off));
  }
}

// Between the samples a bump may stand that no sample sees.
TEST(Quadric, ABumpBetweenTheSamplesIsNotOfSecondDegree) {
  const constraints::Constraint c = constraints::surface({"0.1*u", "0.1*v", "0.05*(u^2 + v^2) + 0.01*exp(-1e6*(u - 0.0123)^2)"});
  const std::optional<Quadric> q = fitted(c);
  ASSERT_TRUE(q);
  EXPECT_FALSE(provesQuadric(c, *q));
  EXPECT_FALSE(provesQuadric({}, *q)) << "nor is what has no formula";
}

TEST(Quadric, AConeHasAnApexAndTwoPlanesALineOfThem) {
  for (const auto& [x, y, z, apex] : {std::tuple{"v*cos(u)/10", "v*sin(u)/10", "v/10", true},
                                      {"0.3 + v*cos(u)/10", "0.2 + v*sin(u)/20", "v/10 - 0.1", true},
                                      {"0.1*cos(u)*cos(v)", "0.08*sin(u)*cos(v)", "0.06*sin(v)", false},
                                      {"0.1*cosh(v)*cos(u)", "0.1*cosh(v)*sin(u)", "0.1*sinh(v)", false},
                                      {"0.1*cos(u)", "0.07*sin(u)", "0.1*v", false},
                                      {"0.1*u", "0.1*v", "0.05*(u^2 + v^2)", false},
                                      {"0.1*u", "0.1*v", "0.05*u*v", false}}) {
    const std::optional<Quadric> q = fitted(constraints::surface({x, y, z}));
    ASSERT_TRUE(q) << z;
    EXPECT_EQ(hasApex(*q), apex) << x << ", " << y << ", " << z;
  }
  Quadric planes;  // x y = 0
  planes.a[3] = 0.5;
  EXPECT_TRUE(hasApex(planes));
  planes.c = 0.01;
  EXPECT_FALSE(hasApex(planes)) << "a hyperbolic cylinder";
  planes.c = 0, planes.b = {0, 0, 1};
  EXPECT_FALSE(hasApex(planes)) << "a saddle";
}

TEST(Quadric, NoSphereHasAnotherFormOrNoRadius) {
  Quadric ball;
  ball.a = {2, 2, 2, 0, 0, 0};
  ball.b = {0.4, -0.8, 1.2};
  ball.c = -0.1;
  ball.centre = {1, 2, 3};
  const std::optional<Sphere> sphere = sphereOf(ball);
  ASSERT_TRUE(sphere);
  EXPECT_LT(norm(sphere->middle - Vec3{0.9, 2.2, 2.7}), 1e-15);
  EXPECT_NEAR(sphere->radius, std::sqrt(0.01 + 0.04 + 0.09 + 0.05), 1e-15);
  for (std::size_t k = 1; k < 6; ++k) {
    Quadric off = ball;
    off.a[k] += 1e-10;
    EXPECT_FALSE(sphereOf(off)) << k;
    off.a[k] = ball.a[k] - 1e-10;
    EXPECT_FALSE(sphereOf(off)) << k;
    off.a[k] = ball.a[k] + 1e-15;
    EXPECT_TRUE(sphereOf(off)) << "but for rounding, " << k;
  }
  ball.c = 0.29;
  EXPECT_FALSE(sphereOf(ball)) << "a square of the radius below nothing";
  ball.c = 0.27;
  EXPECT_TRUE(sphereOf(ball));
}

TEST(Quadric, HoldsAnEllipsoidAwayFromTheOriginEvenWithoutADomain) {
  const std::optional<Quadric> q = fitQuadric(ellipsoid(), kAnywhere, {0.4, 1.2});
  ASSERT_TRUE(q);
  for (double u = 0; u < 6; u += 0.31)
    for (double v = 0; v < 3; v += 0.17) EXPECT_LT(std::abs(q->value(constraints::evaluate(ellipsoid(), u, v).r)), kOffSurface);
}

TEST(Quadric, RefusesWhatIsNotOfSecondDegreeOrNotUnique) {
  for (const auto& [x, y, z, what] : {std::tuple{"(0.1 + 0.04*cos(v))*cos(u)", "(0.1 + 0.04*cos(v))*sin(u)", "0.04*sin(v)", "a torus"},
                                      {"0.1*u", "0.1*v", "0.05*(u^3 - 3*u*v^2)", "a monkey saddle"},
                                      {"0.1*u", "0.1*v", "0.02*u", "a plane: many hold it"},
                                      {"0.1*u", "0.1*v", "0.05*u^2 + 0.01*sqrt(v)", "not finite everywhere"},
                                      {"0.1*u", "0.1*v", "0.05*(u^2 + v^2) + 1e-6*u^3", "nearly"}})
    EXPECT_FALSE(fitted(constraints::surface({x, y, z}))) << what;
  const auto ends = [](double lo, double hi) { return std::array{constraints::Domain{lo, hi}, constraints::Domain{lo, hi}}; };
  const constraints::Constraint root = constraints::surface({"0.1*u", "0.1*v", "0.05*sqrt(2 + u^2 + v^2 - u)"});
  EXPECT_TRUE(fitQuadric(root.surface, ends(-5, 5), {0, 0}));
  const constraints::Constraint half = constraints::surface({"0.1*u", "0.1*v", "0.05*sqrt(u)"});
  EXPECT_TRUE(fitQuadric(half.surface, {constraints::Domain{0, 4}, constraints::Domain{}}, {7, 0})) << "sampled within its domain";
  EXPECT_TRUE(fitQuadric(half.surface, kAnywhere, {3, 0})) << "or three to either side of the start";
  EXPECT_FALSE(fitQuadric(half.surface, kAnywhere, {2, 0}));
  EXPECT_TRUE(fitQuadric(half.surface, {constraints::Domain{}, constraints::Domain{}}, {3, 50}));
}

}  // namespace
}  // namespace reachlab::dynamics
