#include "constraints/regularity/analysis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/error.h"
#include "base/fault.h"
#include "constraints/catalogue/definition.h"
#include "constraints/constraint.h"
#include "constraints/geometry/arc_length.h"
#include "tests/refusal.h"
#include "tests/constraints/made_constraints.h"

namespace reachlab::constraints {
namespace {

TEST(ArcLength, AgreesWithClosedForms) {
  constexpr double kLength = 1e-13;
  const auto lengthOf = [](const Constraint& c, double from, double to) { return ArcLength(c, from, to).length(); };
  EXPECT_NEAR(lengthOf(named("circle"), 0, 2 * kPi), 0.2 * kPi, kLength);
  EXPECT_NEAR(lengthOf(named("circle"), 2 * kPi, kPi), 0.1 * kPi, kLength);
  EXPECT_NEAR(lengthOf(named("astroid"), 0, 2 * kPi), 6 * 0.12, kLength);
  EXPECT_NEAR(lengthOf(named("cardioid"), 0, 2 * kPi), 16 * 0.04, kLength);
  EXPECT_NEAR(lengthOf(named("line"), 0, 2 * kPi), 0.2, kLength);
  // Ellipse: 4 a E(1 - (b/a)^2).
  EXPECT_NEAR(lengthOf(named("ellipse"), 0, 2 * kPi), 0.4 * std::comp_ellint_2(std::sqrt(1 - 0.36)), kLength);
}

int countOf(const std::vector<DegeneratePlace>& places, DegenerateKind kind) {
  return static_cast<int>(std::count_if(places.begin(), places.end(), [&](const DegeneratePlace& p) { return p.kind == kind; }));
}

TEST(DegeneratePlaces, AreToldApartByKind) {
  for (const char* name : {"sphere", "ellipsoid"}) {
    const std::vector<DegeneratePlace> poles = findDegeneratePlaces(named(name));
    ASSERT_EQ(poles.size(), 2u) << name;
    for (const DegeneratePlace& p : poles) {
      EXPECT_EQ(p.kind, DegenerateKind::Pole) << name;
      EXPECT_EQ(p.fixed, 1);
      EXPECT_NEAR(std::abs(p.v), kPi / 2, 1e-9);
      EXPECT_NEAR(std::abs(p.normal.y), 1, 1e-5) << name;  // mean of normals 1e-4 of the range away
    }
  }
  const std::vector<DegeneratePlace> cone = findDegeneratePlaces(named("cone"));
  ASSERT_EQ(cone.size(), 1u);
  EXPECT_EQ(cone[0].kind, DegenerateKind::Apex);
  const std::vector<DegeneratePlace> rim = findDegeneratePlaces(named("pseudosphere"));
  ASSERT_EQ(rim.size(), 1u);
  EXPECT_EQ(rim[0].kind, DegenerateKind::Edge);
  const std::vector<DegeneratePlace> umbrella = findDegeneratePlaces(named("whitney-umbrella"));
  ASSERT_EQ(umbrella.size(), 1u);
  EXPECT_EQ(umbrella[0].kind, DegenerateKind::Pinch);
  EXPECT_NEAR(umbrella[0].u, 0, 1e-9);
  EXPECT_NEAR(umbrella[0].v, 0, 1e-9);
  EXPECT_EQ(countOf(findDegeneratePlaces(named("bohemian-dome")), DegenerateKind::Pinch) > 0, true);
  EXPECT_EQ(countOf(findDegeneratePlaces(named("cross-cap")), DegenerateKind::Pinch) > 0, true);
  for (const char* name : {"torus", "monkey-saddle", "plane", "klein-bottle", "catenoid", "dupin-cyclide", "helicoid"})
    EXPECT_TRUE(findDegeneratePlaces(named(name)).empty()) << name;
}

TEST(Usable, FormulasThatDegenerateEverywhereAreRefused) {
  EXPECT_TRUE(
      holds(refusalOfConstraint({.curve = {"a", "b", "c"}, .shape = {{"a", 0.1}, {"b", 0.2}, {"c", 0.3}}}), "degenerates everywhere"));
  EXPECT_TRUE(holds(refusalOfConstraint({.curve = {"0", "sin(phi)^2 + cos(phi)^2", "1"}}), "degenerates everywhere"));
  EXPECT_TRUE(holds(refusalOfConstraint({.surface = {"u + v", "2*(u + v)", "(u + v)^2"}}), "degenerates everywhere"));
  EXPECT_TRUE(holds(refusalOfConstraint({.surface = {"u", "u^2", "1"}}), "degenerates everywhere"));
}

TEST(Usable, PolesBetweenSamplePointsAreFoundWithTheirPlace) {
  const auto expect = [](const std::string& x, const std::string& place) {
    ConstraintSpec spec{.curve = {x, "phi", "0"}};
    spec.inUse = {Domain{0, 2 * kPi}, Domain{0, 0}};
    const std::string message = refusalOfConstraint(spec);
    EXPECT_TRUE(holds(message, "not finite at phi = " + place)) << x;
  };
  expect("1/(phi - 1)", "1");
  expect("1/(phi - 1.2345678)", "1.2345678");
  expect("log(phi - 2)", "2");  // up to which it has no value
  expect("log(abs(phi - 1.1))", "1.1");
  expect("tan(phi)", "1.5707963");
  expect("1/(phi - 1.3)^2", "1.3");
  expect("sqrt(phi)", "0");                    // its derivative
  expect("sqrt(4 - phi)", "4");                // from where on it has no value
  expect("exp(exp(exp(phi)))", "2.35619449");  // the first of the places looked at beyond 1.88
}

// The motion over a period's end is that of the formula itself: nothing carries a mass back to the beginning.
TEST(Usable, APeriodThatTheFormulaHasNotIsRefused) {
  const auto told = [](const std::string& kind, const std::string& formulas, const std::string& domain, const std::string& periodic) {
    return refusalOf(
        [&] {
          makeConstraint(
              parseDefinition(R"({"schema_version": 1, "name": "made", "kind": ")" + kind + R"(", ")" + kind + R"(": [)" + formulas +
                                  R"(], "shape": {}, "domain": )" + domain + R"(, "periodic": )" + periodic +
                                  R"(, "at_end": "stop", "start": )" + (kind == "curve" ? "[0.1]" : "[0.1, 0.1]") + R"(, "target": )" +
                                  (kind == "curve" ? "[0.2]" : "[0.2, 0.2]") + R"(, "sentence": "s", "source": "s"})",
                              "made"),
              {}, "c");
        },
        "accepted");
  };
  const std::string turn = "[0, \"2*pi\"]";
  EXPECT_EQ(told("curve", R"f("0.1*cos(phi)", "0.1*sin(phi)", "0")f", turn, "true"), "accepted");
  const std::string helix = told("curve", R"f("0.1*cos(phi)", "0.1*sin(phi)", "0.01*phi")f", turn, "true");
  EXPECT_TRUE(helix.starts_with("c.periodic: is true, but r does not repeat itself: its places at phi = ")) << helix;
  EXPECT_TRUE(holds(helix, "; allowed: true for a formula of that period; else false, with at_end stop or bounce"));
  EXPECT_TRUE(holds(helix, " are 0.0628 m apart"));
  // Its ends are one place, but the parameter runs on beyond it.
  EXPECT_TRUE(
      holds(told("curve", R"f("0.1*phi*(1 - phi)", "0.1*phi*(1 - phi)*(2 - phi)", "0")f", "[0, 1]", "true"), "does not repeat itself"));
  EXPECT_TRUE(holds(told("curve", R"f("0.1*phi", "0.1*sqrt(7 - phi)", "0")f", turn, "true"), "but r has a value at phi = "));
  const std::string band = R"f("(0.1 + 0.05*v*cos(u/2))*cos(u)", "(0.1 + 0.05*v*cos(u/2))*sin(u)", "0.05*v*sin(u/2)")f";
  EXPECT_EQ(told("surface", band, "[" + turn + ", [-1, 1]]", "[true, false]"), "accepted")
      << "Moebius' band comes back the other way round";
  EXPECT_TRUE(holds(told("surface", R"f("0.1*cos(u)", "0.1*sin(u)", "0.1*v")f", "[" + turn + ", [0, 1]]", "true"),
                    "c.periodic[1]: is true, but r does not repeat itself: its places at v = "));
  const std::string half = told("surface", R"f("0.1*cos(u)", "v", "0.1*sin(u)")f", "[[0, \"pi\"], [-1, null]]", "[true, false]");
  EXPECT_TRUE(half.starts_with("c.periodic[0]: is true, but r does not repeat itself: its places at u = ")) << half;
  EXPECT_TRUE(holds(half, " are 0.2 m apart")) << "opposite sides of the tube";
}

TEST(Usable, WithoutATaskTheStartDecides) {
  EXPECT_EQ(refusalOfConstraint({.curve = {"log(phi)", "1/phi", "phi"}}), "");
  EXPECT_EQ(refusalOfConstraint({.curve = {"sin(phi)/phi", "phi", "0"}}), "");
  EXPECT_EQ(refusalOfConstraint({.surface = {"u", "v", "1/(u^2 + v^2)"}}), "");
}

TEST(Usable, AMotionAlongAPoleIsNoDegenerateFormula) {
  ConstraintSpec spec{.surface = {"cos(v)*cos(u)/10", "sin(v)/10", "cos(v)*sin(u)/10"}};
  spec.inUse = {Domain{0, 1}, Domain{kPi / 2, kPi / 2}};
  EXPECT_EQ(refusalOfConstraint(spec), "");
}

TEST(Usable, HarmlessDenominatorsAndRootsAreAccepted) {
  EXPECT_NO_THROW(curve({"1/(1.0001 + cos(phi))", "sqrt(2 - sin(phi)^2 - cos(phi)^4)", "exp(-phi^2)"}));
  EXPECT_NO_THROW(curve({"phi/(1 + phi^2)", "atan2(phi, 1 + phi^2)", "abs(phi - 1)"}));
  EXPECT_NO_THROW(curve({"(0.2 + phi)^2.5", "a^phi", "phi^b"}, {{"a", 2}, {"b", 3}}));
}

TEST(Domains, WithoutAnEndAreLookedAtOnATurnOrOnASquare) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const auto bounded = [](ConstraintKind kind, double lo, double hi) {
    Constraint c;
    c.kind = kind;
    c.domain[0].lo = lo, c.domain[0].hi = hi;
    return std::pair(boundedDomain(c)[0].lo, boundedDomain(c)[0].hi);
  };
  using Range = std::pair<double, double>;
  EXPECT_EQ(bounded(ConstraintKind::Curve, -kInf, kInf), Range(0, 2 * kPi));
  EXPECT_EQ(bounded(ConstraintKind::Curve, 3, kInf), Range(3, 3 + 2 * kPi));
  EXPECT_EQ(bounded(ConstraintKind::Curve, -kInf, 3), Range(3 - 2 * kPi, 3));
  EXPECT_EQ(bounded(ConstraintKind::Curve, -5, 7), Range(-5, 7));
  EXPECT_EQ(bounded(ConstraintKind::Surface, -kInf, kInf), Range(-1, 1));
  EXPECT_EQ(bounded(ConstraintKind::Surface, 3, kInf), Range(3, 5));
  EXPECT_EQ(bounded(ConstraintKind::Surface, -kInf, 3), Range(1, 3));
}

TEST(MinSpeed, IsFoundInsideOrAtAnEnd) {
  const Constraint parabola = curve({"0.1*phi", "0.05*(phi - 0.5)^2", "0"});  // |r_phi|^2 = 0.01 (1 + (phi - 1/2)^2)
  for (const auto& [lo, hi, at] : {std::tuple{-1.0, 3.0, 0.5}, {3.0, -1.0, 0.5}, {1.0, 3.0, 1.0}, {-3.0, 0.25, 0.25}}) {
    const SlowPlace slow = findMinSpeed(parabola, lo, hi);
    EXPECT_NEAR(slow.phi, at, 1e-9) << lo << " to " << hi;
    EXPECT_NEAR(slow.speed, 0.1 * std::hypot(1, at - 0.5), 1e-15);
  }
  const Constraint slowest = curve({"sin(phi)*0.1 + 0.2*phi", "0", "0"});  // 0.2 + 0.1 cos(phi)
  EXPECT_NEAR(findMinSpeed(slowest, -40, 40).speed, 0.1, 1e-15);
  EXPECT_NEAR(std::cos(findMinSpeed(slowest, -40, 40).phi), -1, 1e-14);
  EXPECT_THROW((void)findMinSpeed(surface({"u", "v", "0"}), 0, 1), RefusedError);
}

TEST(AngleSine, IsThatOfTheParameterLines) {
  SurfacePoint p;
  p.rU = {2, 0, 0}, p.rV = {3, 3, 0};
  EXPECT_NEAR(computeAngleSine(p), std::sqrt(0.5), 1e-16);
  p.rV = {0, 0, -5};
  EXPECT_EQ(computeAngleSine(p), 1);
  p.rV = {-4, 0, 0};
  EXPECT_EQ(computeAngleSine(p), 0);
  p.rV = {};
  EXPECT_EQ(computeAngleSine(p), 0);
}

TEST(NonFinite, IsToldByTheLowestDerivativeAndItsPlace) {
  const auto ofCurve = [](const std::string& y, double lo, double hi) {
    return findNonFinite(curve({"phi", y, "0"}), {Domain{lo, hi}, Domain{0, 0}});
  };
  EXPECT_EQ(ofCurve("sqrt(phi)", -1, 1), "r is not finite at phi = -1");
  EXPECT_EQ(ofCurve("sqrt(phi)", 0, 1), "r_phi is not finite at phi = 0");
  EXPECT_EQ(ofCurve("phi^1.5", 0, 1), "r_phiphi is not finite at phi = 0");
  EXPECT_EQ(ofCurve("1/(phi - 0.3)", 0, 1), "r is not finite at phi = 0.3");
  EXPECT_EQ(ofCurve("1/(phi - 0.9)", 0, 1), "r is not finite at phi = 0.9");
  EXPECT_EQ(ofCurve("abs(phi - 0.3)^1.5", 0, 1), "r_phiphi is not finite at phi = 0.3");
  EXPECT_EQ(ofCurve("1/(phi - 1.3)", 0, 1), "");
  EXPECT_EQ(ofCurve("sin(phi)/(2 + cos(5*phi))", 0, 100), "");
  const auto ofSurface = [](const std::string& z) { return findNonFinite(surface({"u", "v", z}), {Domain{-1, 1}, Domain{0, 2}}); };
  EXPECT_EQ(ofSurface("sqrt(u)"), "r is not finite at u = -1, v = 0");
  EXPECT_EQ(ofSurface("abs(u)^0.5"), "r_u is not finite at u = 0, v = 0");
  EXPECT_EQ(ofSurface("v^0.5"), "r_v is not finite at u = -1, v = 0");
  EXPECT_EQ(ofSurface("abs(u)^1.5"), "r_uu is not finite at u = 0, v = 0");
  EXPECT_EQ(ofSurface("v^1.5"), "r_vv is not finite at u = -1, v = 0");
  EXPECT_EQ(ofSurface("1/(u - 0.3)").substr(0, 27), "r is not finite at u = 0.3,");
  EXPECT_TRUE(holds(ofSurface("1/(v - 1.7)"), "v = 1.7"));
  EXPECT_EQ(ofSurface("1/((u + 2)*(v + 1))"), "");
  EXPECT_EQ(findNonFinite(named("free"), {Domain{0, 1}, Domain{0, 1}}), "");
}

TEST(DegeneratesEverywhere, IsToldOfTheRangeAlone) {
  const std::array<Domain, 2> range{Domain{0.1, 1}, Domain{0.2, 2}};
  EXPECT_FALSE(degeneratesEverywhere(named("circle"), range));
  EXPECT_FALSE(degeneratesEverywhere(named("sphere"), range));
  EXPECT_FALSE(degeneratesEverywhere(named("free"), range));
  EXPECT_TRUE(degeneratesEverywhere(named("sphere"), {Domain{0.1, 1}, Domain{kPi / 2, kPi / 2}})) << "at its pole";
  EXPECT_FALSE(degeneratesEverywhere(curve({"abs(phi - 0.5) + phi", "0", "0"}), range)) << "still below a half alone";
  EXPECT_TRUE(degeneratesEverywhere(curve({"abs(phi - 0.5) + phi", "0", "0"}), {Domain{0.1, 0.4}, Domain{0, 0}}));
  EXPECT_FALSE(degeneratesEverywhere(curve({"sqrt(-1 - phi^2)", "0", "0"}), range)) << "where there is nothing, nothing degenerates";
}

// A sphere whose latitude is u: what is fixed is the other parameter, and the poles are where they are.
TEST(DegeneratePlaces, AreToldByTheParameterThatIsFixed) {
  Constraint sphere = surface({"0.3*cos(u)*cos(v) + 1", "0.3*cos(u)*sin(v) + 2", "0.3*sin(u) + 3"});
  sphere.domain = {Domain{-kPi / 2, kPi / 2}, Domain{0, 2 * kPi, true}};
  const std::vector<DegeneratePlace> poles = findDegeneratePlaces(sphere);
  ASSERT_EQ(poles.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const double side = k == 0 ? -1 : 1;
    EXPECT_EQ(poles[k].kind, DegenerateKind::Pole);
    EXPECT_EQ(poles[k].fixed, 0);
    EXPECT_NEAR(poles[k].u, side * kPi / 2, 1e-9);
    EXPECT_NEAR(norm(poles[k].r - Vec3{1, 2, 3 + 0.3 * side}), 0, 1e-9);
    EXPECT_NEAR(std::abs(poles[k].normal.z), 1, 1e-5);
  }
  Constraint cone = surface({"u*cos(v)", "u*sin(v)", "2*u + 1"});
  cone.domain = {Domain{-0.37, 1}, Domain{0, 2 * kPi, true}};
  const std::vector<DegeneratePlace> tip = findDegeneratePlaces(cone);
  ASSERT_EQ(tip.size(), 1u) << "inside of its range, between the lines that are looked at";
  EXPECT_EQ(tip[0].kind, DegenerateKind::Apex);
  EXPECT_EQ(tip[0].fixed, 0);
  EXPECT_NEAR(tip[0].u, 0, 1e-9);
  EXPECT_NEAR(norm(tip[0].r - Vec3{0, 0, 1}), 0, 1e-8);
}

TEST(DegeneratePlaces, ACuspidalEdgeIsALineOfPlacesAndAPinchIsOne) {
  for (const int fixed : {0, 1}) {
    Constraint edge = fixed == 0 ? surface({"(u - 0.3)^2", "(u - 0.3)^3", "v"}) : surface({"u", "(v - 0.3)^2", "(v - 0.3)^3"});
    edge.domain = {Domain{-1, 1}, Domain{-0.5, 1}};
    const std::vector<DegeneratePlace> places = findDegeneratePlaces(edge);
    ASSERT_EQ(places.size(), 1u);
    EXPECT_EQ(places[0].kind, DegenerateKind::Edge);
    EXPECT_EQ(places[0].fixed, fixed);
    EXPECT_NEAR(fixed == 0 ? places[0].u : places[0].v, 0.3, 1e-7);
  }
  Constraint umbrella = surface({"(u - 0.21)*(v - 0.13)", "u", "(v - 0.13)^2"});  // Whitney's, moved
  umbrella.domain = {Domain{-1, 1.5}, Domain{-0.5, 0.8}};
  const std::vector<DegeneratePlace> pinch = findDegeneratePlaces(umbrella);
  ASSERT_EQ(pinch.size(), 1u);
  EXPECT_EQ(pinch[0].kind, DegenerateKind::Pinch);
  EXPECT_EQ(pinch[0].fixed, -1);
  EXPECT_NEAR(pinch[0].u, 0.21, 1e-7);
  EXPECT_NEAR(pinch[0].v, 0.13, 1e-7);
  EXPECT_NEAR(norm(pinch[0].r - Vec3{0, 0.21, 0}), 0, 1e-7);
  EXPECT_TRUE(findDegeneratePlaces(named("circle")).empty());
}

// s = a sinh(phi) on a catenary, from either end; and of a spiral whose pace grows a hundredfold.
TEST(ArcLength, FindsTheParameterWhereSoMuchIsDone) {
  const Constraint catenary = named("catenary");
  for (const auto& [from, to] : {std::pair{-0.4, 1.3}, {1.3, -0.4}}) {
    const ArcLength way(catenary, from, to);
    EXPECT_NEAR(way.length(), 0.08 * (std::sinh(1.3) + std::sinh(0.4)), 1e-14);
    for (const double part : {0.0, 0.1, 0.5, 0.93, 1.0}) {
      const double done = part * way.length() * (to > from ? 1 : -1);
      EXPECT_NEAR(way.parameterAt(part * way.length()), std::asinh(std::sinh(from) + done / 0.08), 1e-12) << part;
    }
    EXPECT_NEAR(way.parameterAt(2 * way.length()), to, 1e-12) << "beyond it the end";
  }
  const ArcLength spiral(curve({"0.1*exp(phi)*cos(phi)", "0.1*exp(phi)*sin(phi)", "0"}), 0, std::log(100.0));
  EXPECT_NEAR(spiral.length(), 0.1 * std::sqrt(2.0) * 99, 1e-11);
  EXPECT_NEAR(spiral.parameterAt(0.1 * std::sqrt(2.0) * 9), std::log(10.0), 1e-11);
  const auto refused = [](const Constraint& c) -> std::string { return refusalOf([&] { (void)ArcLength(c, -1, 1); }); };
  EXPECT_EQ(refused(named("sphere")), "sphere is no curve");
  EXPECT_EQ(refused(curve({"phi", "sqrt(phi)", "0"})).substr(0, 66), "the curve has no value, or no end to its length, near phi = -1.000");
  EXPECT_NEAR(ArcLength(curve({"phi", "abs(phi - 0.3)", "0"}), 0, 1).length(), std::sqrt(2.0), 1e-12) << "over a kink";
}

}  // namespace
}  // namespace reachlab::constraints
