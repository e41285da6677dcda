#include "constraints/constraint.h"
#include "gui/scene_plan/constraint_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace reachlab::gui::scene {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Only the positions are asked for here.
constraints::Curve curveOf(constraints::CurveFunction function) { return {function, nullptr, {}}; }

void ellipse(const void*, const double*, double phi, constraints::CurvePoint& out) noexcept {
  out = {{0.1 * std::cos(phi), 0.02 * std::sin(phi), 0}, {}, {}};
}
void bump(const void*, const double*, double phi, constraints::CurvePoint& out) noexcept {
  out = {{phi, 1 / (1 + 2000 * (phi - 3) * (phi - 3)), 0}, {}, {}};
}
void buzz(const void*, const double*, double phi, constraints::CurvePoint& out) noexcept { out = {{phi, std::sin(5000 * phi), 0}, {}, {}}; }
void pole(const void*, const double*, double phi, constraints::CurvePoint& out) noexcept {
  out = {{phi, phi == std::numbers::pi ? NAN : 1 / (phi - std::numbers::pi), 0}, {}, {}};
}
void half(const void*, const double*, double phi, constraints::CurvePoint& out) noexcept { out = {{phi, std::sqrt(phi - 1), 0}, {}, {}}; }
void ball(const void*, const double*, double u, double v, constraints::SurfacePoint& out) noexcept {
  out.r = {std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)};
  out.rU = {std::cos(u) * std::cos(v), std::cos(u) * std::sin(v), -std::sin(u)};
  out.rV = {-std::sin(u) * std::sin(v), std::sin(u) * std::cos(v), 0};
}

TEST(CurveMesh, ChordsStayWithinTheErrorThatWasAskedFor) {
  const MeshOptions options;
  const CurveMesh mesh = sampleCurve(curveOf(ellipse), 0, kTurn, options);
  ASSERT_EQ(mesh.pieces.size(), 1u);
  const auto& points = mesh.pieces[0];
  const double allowed = options.chordError * boxOf(mesh).diagonal();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 middle = 0.5 * (points[i] + points[i + 1]);
    // Distance of the chord's middle from the ellipse to first order: |F| / |grad F|.
    const double f = std::pow(middle.x / 0.1, 2) + std::pow(middle.y / 0.02, 2) - 1;
    const double gradient = 2 * std::hypot(middle.x / 0.01, middle.y / 0.0004);
    EXPECT_LT(std::abs(f) / gradient, allowed);
  }
}

TEST(CurveMesh, PointsLieCloserWhereTheCurveBends) {
  const CurveMesh mesh = sampleCurve(curveOf(bump), 0, kTurn);
  std::size_t top = 0, plain = 0;
  for (const Vec3& p : mesh.pieces[0]) (std::abs(p.x - 3) < 0.3 ? top : plain) += 1;
  // The bump holds a tenth of the parameter's range and nearly all of the bend.
  EXPECT_GT(static_cast<double>(top), 0.15 * static_cast<double>(top + plain));
}

TEST(CurveMesh, AWildFormulaCostsNoMoreThanTheBound) {
  const MeshOptions options;
  EXPECT_LE(sampleCurve(curveOf(buzz), 0, kTurn, options).pointCount(), options.maxPoints);
}

TEST(CurveMesh, ANewPieceBeginsWhereTheFormulaIsNotFinite) {
  EXPECT_EQ(sampleCurve(curveOf(pole), 0, kTurn).pieces.size(), 2u);
  const CurveMesh begun = sampleCurve(curveOf(half), 0, kTurn);
  ASSERT_EQ(begun.pieces.size(), 1u);
  EXPECT_NEAR(begun.pieces[0].front().x, 1, 1e-3);  // found by halving to within 1/64 of a piece of 2 pi / 96
}

TEST(SurfaceMesh, NormalsAreUnitAndPointOutwardAlsoAtThePoles) {
  const std::array<constraints::Domain, 2> domain{constraints::Domain{0, std::numbers::pi}, constraints::Domain{0, kTurn, true}};
  const SurfaceMesh mesh = sampleSurface({ball, nullptr, {}}, domain);
  ASSERT_FALSE(mesh.quads.empty());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_NEAR(norm(mesh.normals[i]), 1, 1e-12);
    EXPECT_GT(std::abs(dot(mesh.normals[i], mesh.points[i])), 0.95);  // at a pole the mean of its quads
  }
  EXPECT_LE(mesh.points.size(), MeshOptions{}.maxLines * MeshOptions{}.maxLines);
}

TEST(DrawnDomain, AnEndlessLineIsDrawnBeyondStartAndTarget) {
  constraints::Constraint line;
  line.kind = constraints::ConstraintKind::Curve;
  const std::vector<double> start{0}, target{kTurn};
  const constraints::Domain drawn = drawnDomain(line, start, target)[0];
  EXPECT_LT(drawn.lo, 0);
  EXPECT_GT(drawn.hi, kTurn);
}

}  // namespace
}  // namespace reachlab::gui::scene
