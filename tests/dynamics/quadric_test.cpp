#include "sim/dynamics/quadric.h"

#include <gtest/gtest.h>

#include <numbers>

namespace reachlab::dynamics {
namespace {

constexpr double kPi = std::numbers::pi;
// Ten coefficients found to 1e-15 of a surface of 0.1 m.
constexpr double kOffSurface = 1e-15;  // [m]

constraints::Surface sphere() {
  return {[](const void*, const double*, double u, double v, constraints::SurfacePoint& p) noexcept {
            p.r = {0.1 * std::sin(v) * std::cos(u), 0.1 * std::sin(v) * std::sin(u), 0.1 * std::cos(v)};
          },
          nullptr,
          {}};
}
constraints::Surface ellipsoid() {
  return {[](const void*, const double*, double u, double v, constraints::SurfacePoint& p) noexcept {
            p.r = {0.2 + 0.1 * std::sin(v) * std::cos(u), 0.07 * std::sin(v) * std::sin(u) - 0.1, 0.04 * std::cos(v)};
          },
          nullptr,
          {}};
}
constraints::Surface torus() {
  return {[](const void*, const double*, double u, double v, constraints::SurfacePoint& p) noexcept {
            p.r = {(0.1 + 0.04 * std::cos(v)) * std::cos(u), (0.1 + 0.04 * std::cos(v)) * std::sin(u), 0.04 * std::sin(v)};
          },
          nullptr,
          {}};
}
constraints::Surface plane() {
  return {[](const void*, const double*, double u, double v, constraints::SurfacePoint& p) noexcept {
            p.r = {0.1 * u, 0.1 * v, 0.02 * u};
          },
          nullptr,
          {}};
}
constraints::Surface monkeySaddle() {
  return {[](const void*, const double*, double u, double v, constraints::SurfacePoint& p) noexcept {
            p.r = {0.1 * u, 0.1 * v, 0.05 * (u * u * u - 3 * u * v * v)};
          },
          nullptr,
          {}};
}

const std::array<constraints::Domain, 2> kAnywhere{};
const std::array<constraints::Domain, 2> kRound{constraints::Domain{0, 2 * kPi, true}, constraints::Domain{0, kPi, false}};

TEST(Quadric, HoldsTheSphereAndPointsOutward) {
  const std::optional<Quadric> q = fitQuadric(sphere(), kRound, {0, 1});
  ASSERT_TRUE(q);
  for (double u = 0.05; u < 6; u += 0.31)
    for (double v = 0.0; v <= kPi; v += 0.17) {
      const Vec3 r = constraints::evaluate(sphere(), u, v).r;
      EXPECT_LT(std::abs(q->value(r)), kOffSurface);
      const Vec3 gradient = q->gradient(r);
      EXPECT_LT(norm(cross(gradient, r)), 1e-14 * norm(gradient));
    }
}

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

TEST(Quadric, HoldsAnEllipsoidAwayFromTheOriginEvenWithoutADomain) {
  const std::optional<Quadric> q = fitQuadric(ellipsoid(), kAnywhere, {0.4, 1.2});
  ASSERT_TRUE(q);
  for (double u = 0; u < 6; u += 0.31)
    for (double v = 0; v < 3; v += 0.17) EXPECT_LT(std::abs(q->value(constraints::evaluate(ellipsoid(), u, v).r)), kOffSurface);
}

TEST(Quadric, RefusesWhatIsNotOfSecondDegreeOrNotUnique) {
  EXPECT_FALSE(fitQuadric(torus(), kAnywhere, {0, 0}));
  EXPECT_FALSE(fitQuadric(monkeySaddle(), kAnywhere, {0, 0}));
  EXPECT_FALSE(fitQuadric(plane(), kAnywhere, {0, 0}));
}

}  // namespace
}  // namespace reachlab::dynamics
