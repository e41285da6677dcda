#include "constraints/analysis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "constraints/definition.h"
#include "constraints/geometry/arc_length.h"
#include "base/error.h"
#include "base/fault.h"

namespace reachlab::constraints {
namespace {

constexpr double kPi = std::numbers::pi;

Constraint named(const std::string& name, const std::map<std::string, double>& shape = {}) {
  return makeConstraint({.name = name, .curve = {}, .surface = {}, .shape = shape});
}
Constraint curve(const std::vector<std::string>& formula, const std::map<std::string, double>& shape = {}) {
  return makeConstraint({.name = {}, .curve = formula, .surface = {}, .shape = shape});
}
std::string refusal(const ConstraintSpec& spec) {
  try {
    makeConstraint(spec, "here");
  } catch (const FaultError& e) {
    return e.what();
  }
  return "accepted";
}

// A cusp is found by the sign of r_phi . r_phiphi, which rounding blurs over about 1e-15 of the parameter.
constexpr double kPlace = 1e-12;

TEST(Cusps, AreFoundWhereTheCurveTurnsBack) {
  const auto expect = [](const std::string& name, const std::map<std::string, double>& shape, std::vector<double> places) {
    const Constraint c = named(name, shape);
    const std::vector<double> found = findCusps(c, 0, 2 * kPi - 0.01);
    ASSERT_EQ(found.size(), places.size()) << name;
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(found[i], places[i], kPlace) << name;
  };
  expect("astroid", {}, {0, kPi / 2, kPi, 3 * kPi / 2});
  expect("cardioid", {}, {0});
  expect("nephroid", {}, {0, kPi});
  expect("deltoid", {}, {0, 2 * kPi / 3, 4 * kPi / 3});
  expect("epicycloid", {{"cusps", 5}}, {0, 2 * kPi / 5, 4 * kPi / 5, 6 * kPi / 5, 8 * kPi / 5});
  expect("epitrochoid", {{"d_m", 0.02}, {"a_m", 0.08}}, {0, 2 * kPi / 3, 4 * kPi / 3});
  expect("ellipse", {}, {});
}

TEST(Cusps, ANearCuspIsNone) {
  // d = 0.1 % short of a cusp: the slowest place moves at 0.1 % of a, far above the threshold of 1e-9.
  const Constraint c = named("epitrochoid", {{"d_m", 0.01998}, {"a_m", 0.08}});
  EXPECT_TRUE(findCusps(c, 0, 2 * kPi).empty());
  EXPECT_NEAR(findMinSpeed(c, 1, 3).speed, 0.08 - 4 * 0.01998, 1e-15);
  EXPECT_NEAR(findMinSpeed(c, 1, 3).phi, 2 * kPi / 3, 1e-9);
}

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

TEST(HigherDerivatives, OfTheAstroidMatchItsMultipleAngles) {
  // cos^3 = (3 cos + cos 3)/4: derivatives of order n are (3 cos(phi + n pi/2) + 3^n cos(3 phi + n pi/2))/4.
  const double phi = 0.83;
  const std::vector<Vec3> d = computeDerivatives(named("astroid"), phi, 4);
  ASSERT_EQ(d.size(), 5u);
  for (int n = 0; n <= 4; ++n)
    EXPECT_NEAR(d[static_cast<std::size_t>(n)].x,
                0.12 * (3 * std::cos(phi + n * kPi / 2) + std::pow(3, n) * std::cos(3 * phi + n * kPi / 2)) / 4, 1e-14)
        << n;
  EXPECT_THROW(computeDerivatives(named("astroid"), 0, 5), RefusedError);
  EXPECT_THROW(computeDerivatives(named("torus"), 0, 1), RefusedError);
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
  EXPECT_NE(refusal({.name = {}, .curve = {"a", "b", "c"}, .surface = {}, .shape = {{"a", 0.1}, {"b", 0.2}, {"c", 0.3}}})
                .find("degenerates everywhere"),
            std::string::npos);
  EXPECT_NE(
      refusal({.name = {}, .curve = {"0", "sin(phi)^2 + cos(phi)^2", "1"}, .surface = {}, .shape = {}}).find("degenerates everywhere"),
      std::string::npos);
  EXPECT_NE(refusal({.name = {}, .curve = {}, .surface = {"u + v", "2*(u + v)", "(u + v)^2"}, .shape = {}}).find("degenerates everywhere"),
            std::string::npos);
  EXPECT_NE(refusal({.name = {}, .curve = {}, .surface = {"u", "u^2", "1"}, .shape = {}}).find("degenerates everywhere"),
            std::string::npos);
}

TEST(Usable, PolesBetweenSamplePointsAreFoundWithTheirPlace) {
  const auto expect = [](const std::string& x, const std::string& place) {
    ConstraintSpec spec{.name = {}, .curve = {x, "phi", "0"}, .surface = {}, .shape = {}};
    spec.inUse = {Domain{0, 2 * kPi}, Domain{0, 0}};
    const std::string message = refusal(spec);
    EXPECT_NE(message.find("not finite at phi = " + place), std::string::npos) << x << ": " << message;
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
    try {
      makeConstraint(parseDefinition(R"({"schema_version": 1, "name": "made", "kind": ")" + kind + R"(", ")" + kind + R"(": [)" + formulas +
                                         R"(], "shape": {}, "domain": )" + domain + R"(, "periodic": )" + periodic +
                                         R"(, "at_end": "stop", "start": )" + (kind == "curve" ? "[0.1]" : "[0.1, 0.1]") +
                                         R"(, "target": )" + (kind == "curve" ? "[0.2]" : "[0.2, 0.2]") +
                                         R"(, "sentence": "s", "source": "s"})",
                                     "made"));
    } catch (const FaultError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  const std::string turn = "[0, \"2*pi\"]";
  EXPECT_EQ(told("curve", R"f("0.1*cos(phi)", "0.1*sin(phi)", "0")f", turn, "true"), "accepted");
  const std::string helix = told("curve", R"f("0.1*cos(phi)", "0.1*sin(phi)", "0.01*phi")f", turn, "true");
  EXPECT_NE(helix.find("periodic: is true, but r does not repeat itself: its places at phi = "), std::string::npos) << helix;
  EXPECT_NE(helix.find(" are 0.0628 m apart"), std::string::npos) << helix;
  // Its ends are one place, but the parameter runs on beyond it.
  EXPECT_NE(told("curve", R"f("0.1*phi*(1 - phi)", "0.1*phi*(1 - phi)*(2 - phi)", "0")f", "[0, 1]", "true").find("does not repeat itself"),
            std::string::npos);
  EXPECT_NE(told("curve", R"f("0.1*phi", "0.1*sqrt(7 - phi)", "0")f", turn, "true").find("but r has a value at phi = "), std::string::npos);
  const std::string band = R"f("(0.1 + 0.05*v*cos(u/2))*cos(u)", "(0.1 + 0.05*v*cos(u/2))*sin(u)", "0.05*v*sin(u/2)")f";
  EXPECT_EQ(told("surface", band, "[" + turn + ", [-1, 1]]", "[true, false]"), "accepted")
      << "Moebius' band comes back the other way round";
  EXPECT_NE(told("surface", R"f("0.1*cos(u)", "0.1*sin(u)", "0.1*v")f", "[" + turn + ", [0, 1]]", "true").find("periodic[1]: is true"),
            std::string::npos);
}

TEST(Usable, JumpsBetweenStartAndTargetAreRefused) {
  ConstraintSpec spec{.name = {}, .curve = {"phi/10", "sign(phi - 1)/20", "0"}, .surface = {}, .shape = {}};
  spec.inUse = {Domain{0, 2}, Domain{0, 0}};
  EXPECT_NE(refusal(spec).find("jump at phi = 1: sign(phi - 1), which no mass can cross"), std::string::npos) << refusal(spec);
  spec.inUse = {Domain{1.1, 2}, Domain{0, 0}};
  EXPECT_EQ(refusal(spec), "accepted");
}

TEST(Usable, WithoutATaskTheStartDecides) {
  EXPECT_EQ(refusal({.name = {}, .curve = {"log(phi)", "1/phi", "phi"}, .surface = {}, .shape = {}}), "accepted");
  EXPECT_EQ(refusal({.name = {}, .curve = {"sin(phi)/phi", "phi", "0"}, .surface = {}, .shape = {}}), "accepted");
  EXPECT_EQ(refusal({.name = {}, .curve = {}, .surface = {"u", "v", "1/(u^2 + v^2)"}, .shape = {}}), "accepted");
}

TEST(Usable, OnlyWhereItIsMovedOnMustItBeFinite) {
  ConstraintSpec spec{.name = {}, .curve = {"log(phi)", "1/phi", "phi"}, .surface = {}, .shape = {}};
  spec.inUse = {Domain{-1, 1}, Domain{0, 0}};
  EXPECT_NE(refusal(spec).find("not finite at phi = 0"), std::string::npos) << refusal(spec);
  spec.inUse = {Domain{1, 2}, Domain{0, 0}};
  EXPECT_EQ(refusal(spec), "accepted");
}

TEST(Usable, AMotionAlongAPoleIsNoDegenerateFormula) {
  ConstraintSpec spec{.name = {}, .curve = {}, .surface = {"cos(v)*cos(u)/10", "sin(v)/10", "cos(v)*sin(u)/10"}, .shape = {}};
  spec.inUse = {Domain{0, 1}, Domain{kPi / 2, kPi / 2}};
  EXPECT_EQ(refusal(spec), "accepted");
}

TEST(Usable, HarmlessDenominatorsAndRootsAreAccepted) {
  EXPECT_NO_THROW(curve({"1/(1.0001 + cos(phi))", "sqrt(2 - sin(phi)^2 - cos(phi)^4)", "exp(-phi^2)"}));
  EXPECT_NO_THROW(curve({"phi/(1 + phi^2)", "atan2(phi, 1 + phi^2)", "abs(phi - 1)"}));
  EXPECT_NO_THROW(curve({"(0.2 + phi)^2.5", "a^phi", "phi^b"}, {{"a", 2}, {"b", 3}}));
}

TEST(TypedFormula, UnusedShapeIsNamed) {
  EXPECT_NE(refusal({.name = {}, .curve = {"a*phi", "0", "0"}, .surface = {}, .shape = {{"a", 1}, {"b", 1}}})
                .find("shape.b is used by no coordinate"),
            std::string::npos);
  EXPECT_NE(refusal({.name = {}, .curve = {"phi", "0", "0"}, .surface = {}, .shape = {{"phi", 1}}}).find("variable"), std::string::npos);
  EXPECT_NE(refusal({.name = {}, .curve = {"phi", "0"}, .surface = {}, .shape = {}}).find("allowed: three"), std::string::npos);
}

}  // namespace
}  // namespace reachlab::constraints
