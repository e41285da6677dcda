#include "constraints/geometry/arc_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "base/error.h"
#include "constraints/geometry/arc_length.h"
#include "tests/refusal.h"

namespace reachlab::constraints {
namespace {

constexpr double kPi = std::numbers::pi;
using Complex = std::complex<double>;

Constraint typed(const std::string& x, const std::string& y, const std::string& z = "0") {
  return makeConstraint({.name = {}, .curve = {x, y, z}, .surface = {}, .shape = {}});
}
Constraint named(const std::string& name) { return makeConstraint({.name = name, .curve = {}, .surface = {}, .shape = {}}); }

std::string refusal(const Constraint& curve, double start, double target, Along along = Along::ArcLength) {
  return reachlab::refusalOf([&] { (void)ArcCurve(curve, start, target, along); });
}
std::string refusedFor(const std::string& what, const std::string& phi) {
  return "the curve has " + what + " at phi = " + phi +
         ", between start and target: no movement of finite jerk passes it but at rest; allowed: a start and a target with none between them";
}

/// a exp((g + i) phi) in the plane: its way from phi0 is (a/g) sqrt(1 + g^2) (exp(g phi) - exp(g phi0)), so that r(s) = r0 (1 + k s)^(1 + i/g).
struct LogarithmicSpiral {
  static constexpr double kA = 0.03, kG = 0.12;
  static Complex at(double phi) { return kA * std::exp(Complex(kG, 1) * phi); }
  static double way(double from, double to) { return kA / kG * std::sqrt(1 + kG * kG) * (std::exp(kG * to) - std::exp(kG * from)); }
  /// The m-th derivative by s, s being counted from `start` the way that `direction` says.
  static Complex byWay(double start, double direction, double s, int m) {
    const double k = direction * kG / (kA * std::exp(kG * start) * std::sqrt(1 + kG * kG));
    const Complex power(1, 1 / kG);
    Complex factor = at(start) * std::pow(Complex(1 + k * s), power - static_cast<double>(m));
    for (int i = 0; i < m; ++i) factor *= k * (power - static_cast<double>(i));
    return factor;
  }
  static Complex byParameter(double start, double direction, double s, int m) {
    return std::pow(direction * Complex(kG, 1), m) * at(start + direction * s);
  }
};

void expectDerivatives(const ArcCurve& curve, double s, const std::function<Complex(int)>& expected) {
  const auto five = curve.expand<5>(s);
  for (std::size_t m = 0; m <= 5; ++m) {
    const Complex e = expected(static_cast<int>(m));
    EXPECT_NEAR(five[m].x, e.real(), (m < 5 ? 1e-9 : 1e-6) * std::abs(e)) << "order " << m << " at s = " << s;
    EXPECT_NEAR(five[m].y, e.imag(), (m < 5 ? 1e-9 : 1e-6) * std::abs(e)) << "order " << m << " at s = " << s;
    EXPECT_EQ(five[m].z, 0);
  }
  for (std::size_t m = 0; m <= 2; ++m) EXPECT_EQ(curve.expand<2>(s)[m], five[m]);
  for (std::size_t m = 0; m <= 3; ++m) EXPECT_EQ(curve.expand<3>(s)[m], five[m]);
}

TEST(ArcCurve, HasTheDerivativesOfTheLogarithmicSpiral) {
  const Constraint spiral = named("logarithmic-spiral");
  for (const auto& [start, target] : {std::pair{5.0, 8.5}, {8.5, 5.0}}) {
    const double direction = target > start ? 1 : -1, length = std::abs(LogarithmicSpiral::way(start, target));
    const ArcCurve curve(spiral, start, target);
    EXPECT_NEAR(curve.length(), length, 1e-12);
    EXPECT_NEAR(curve.lowest(), -std::abs(LogarithmicSpiral::way(start, start - (target - start) / 2)), 1e-12) << "half the way of phi";
    EXPECT_NEAR(curve.highest(), std::abs(LogarithmicSpiral::way(start, target + (target - start) / 2)), 1e-12);
    for (const double part : {-0.3, 0.0, 0.2, 0.63, 1.0, 1.3})
      expectDerivatives(curve, part * length, [&, s0 = start](int m) { return LogarithmicSpiral::byWay(s0, direction, part * length, m); });
  }
}

TEST(ArcCurve, MayRunByItsParameter) {
  const Constraint spiral = named("logarithmic-spiral");
  for (const auto& [start, target] : {std::pair{5.0, 8.5}, {8.5, 5.0}}) {
    const double direction = target > start ? 1 : -1;
    const ArcCurve curve(spiral, start, target, Along::Parameter);
    EXPECT_NEAR(curve.length(), 3.5, 1e-14);
    EXPECT_NEAR(curve.lowest(), -1.75, 1e-14);
    EXPECT_NEAR(curve.highest(), 5.25, 1e-14);
    for (const double s : {-1.2, 0.0, 0.4, 2.1, 3.5, 4.9})
      expectDerivatives(curve, s, [&, s0 = start](int m) { return LogarithmicSpiral::byParameter(s0, direction, s, m); });
  }
}

TEST(ArcCurve, GoesOnStraightWhereItIsNotKnown) {
  const ArcCurve curve(named("logarithmic-spiral"), 1, 12);  // the definition's own range ends at 0 and 4 pi
  EXPECT_NEAR(curve.lowest(), -LogarithmicSpiral::way(0, 1), 1e-12);
  EXPECT_NEAR(curve.highest(), LogarithmicSpiral::way(1, 4 * kPi), 1e-12);
  for (const auto& [end, s] : {std::pair{curve.lowest(), curve.lowest() - 0.07}, {curve.highest(), curve.highest() + 0.11}}) {
    const auto at = curve.expand<3>(end), beyond = curve.expand<3>(s);
    EXPECT_NEAR(norm(beyond[0] - (at[0] + (s - end) * at[1])), 0, 1e-15);
    EXPECT_EQ(beyond[1], at[1]);
    EXPECT_EQ(beyond[2], Vec3{});
    EXPECT_EQ(beyond[3], Vec3{});
    EXPECT_NE(at[2], Vec3{});
  }
}

TEST(ArcCurve, APartOfItMagnifiedKeepsItsDirectionAndBendsLess) {
  const ArcCurve whole(named("logarithmic-spiral"), 5, 8.5);
  const double s = 0.8 * whole.length();
  for (const double part : {1.0, 0.4, 1e-3}) {
    const auto there = whole.expand<3>(part * s), origin = whole.expand<3>(0), magnified = whole.magnified(part).expand<3>(s);
    const Vec3 from = part == 1 ? Vec3{} : origin[0];
    EXPECT_NEAR(norm(magnified[0] - (there[0] - from) / part), 0, 1e-13);
    EXPECT_NEAR(norm(magnified[1] - there[1]), 0, 1e-14);
    EXPECT_NEAR(norm(magnified[2] - part * there[2]), 0, 1e-14 * norm(there[2]));
    EXPECT_NEAR(norm(magnified[3] - part * part * there[3]), 0, 1e-14 * norm(there[3]));
  }
  const auto line = whole.magnified(0).expand<3>(s);
  EXPECT_NEAR(norm(line[0] - s * whole.expand<2>(0)[1]), 0, 1e-15);
  EXPECT_EQ(line[1], whole.expand<2>(0)[1]);
  EXPECT_EQ(line[2], Vec3{});
}

// Away from the origin and in three coordinates that differ: the place is the formula's own where that much of the way is done.
TEST(ArcCurve, IsTheFormulaWhereSoMuchOfTheWayIsDone) {
  const Constraint curve = typed("0.3 + 0.1*phi^2", "0.05*sin(3*phi) - 2", "0.08*phi");
  for (const auto& [start, target] : {std::pair{-0.7, 1.1}, {1.1, -0.7}}) {
    const ArcCurve arc(curve, start, target);
    const ArcLength way(curve, start, target);
    EXPECT_NEAR(arc.length(), way.length(), 1e-12);
    for (int i = 0; i <= 20; ++i) {
      const double s = arc.length() * i / 20;
      const CurvePoint p = evaluate(curve.curve, way.parameterAt(s));
      const auto at = arc.expand<2>(s);
      const double direction = target > start ? 1 : -1, square = dot(p.rPhi, p.rPhi);
      EXPECT_NEAR(norm(at[0] - p.r), 0, 1e-11);
      EXPECT_NEAR(norm(at[1] - direction * p.rPhi / norm(p.rPhi)), 0, 1e-9);
      EXPECT_NEAR(norm(at[2] - (p.rPhiPhi - dot(p.rPhi, p.rPhiPhi) / square * p.rPhi) / square), 0, 1e-7);
    }
  }
}

TEST(ArcCurve, AChangeOfPaceIsNoneInArcLength) {
  const Constraint uneven = typed("0.1*(2*phi + abs(phi))", "0", "0");  // 0.1 m a unit below 0, 0.3 m above
  const ArcCurve curve(uneven, -1, 1);
  EXPECT_NEAR(curve.length(), 0.4, 1e-12);
  for (const double s : {0.0, 0.05, 0.1, 0.25, 0.4}) {
    EXPECT_NEAR(curve.expand<2>(s)[0].x, -0.1 + s, 1e-9) << s;
    EXPECT_NEAR(curve.expand<2>(s)[1].x, 1, 1e-9) << s;
  }
}

TEST(ArcCurve, RefusesInWordsWhatNoSmoothMovementPasses) {
  EXPECT_EQ(refusal(typed("phi/10", "0.1*abs(phi - 0.5)"), 0, 2),
            refusedFor("a kink (its direction turns by 90 degrees at abs(phi - 0.5))", "0.5"));
  EXPECT_EQ(refusal(typed("phi/10", "0.1*abs(phi - 0.5)/sqrt(3)"), 2, 0),
            refusedFor("a kink (its direction turns by 60 degrees at abs(phi - 0.5))", "0.5"));
  EXPECT_EQ(refusal(typed("phi/10", "0.1*phi*abs(phi)"), -1, 2), refusedFor("a step of its curvature (abs(phi))", "0"));
  EXPECT_EQ(refusal(typed("phi/10", "0.15*sign(phi - 1)"), 0, 2), refusedFor("a jump of 0.3 m (sign(phi - 1))", "1"));
  EXPECT_EQ(refusal(typed("phi/10", "0.1*sqrt(abs(phi))"), -1, 2), refusedFor("a spike (sqrt(abs(phi)))", "0"));
  EXPECT_EQ(refusal(typed("phi^2", "phi^3"), -1, 3), refusedFor("a cusp, or a place where it stands still,", "0"));
  EXPECT_EQ(refusal(typed("phi/10", "0.1*abs(phi - 0.5)"), 0.5, 2), "") << "at the start it is met at rest";
  EXPECT_EQ(refusal(typed("phi/10", "0.1*abs(phi - 0.5)"), 0, 0.5), "");
  EXPECT_NE(refusal(typed("0.1*(2*phi + abs(phi))", "0"), -1, 1, Along::Parameter), "") << "the pace changes";
}

}  // namespace
}  // namespace reachlab::constraints
