#include "constraints/regularity/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "base/fault.h"
#include "constraints/catalogue/definition.h"
#include "constraints/regularity/surface_branches.h"
#include "tests/refusal.h"
#include "tests/constraints/made_constraints.h"

namespace reachlab::constraints {
namespace {

Constraint typedCurve(const std::string& x, const std::string& y, const std::string& z = "0") { return curve({x, y, z}); }
std::vector<std::string> placesOf(const std::string& y, double from = -1.01, double to = 2.02) {
  std::vector<std::string> told;
  for (const Place& place : placesBetween(computeRegularity(typedCurve("phi/10", y), 0.4), from, to))
    told.push_back(describe(place, ConstraintKind::Curve));
  return told;
}
using Told = std::vector<std::string>;

TEST(Places, EachKindIsFoundWithItsPlaceAndItsOperation) {
  EXPECT_EQ(placesOf("abs(phi)"), Told{"kink at phi = 0: abs(phi)"});
  EXPECT_EQ(placesOf("sqrt((phi - 1)^2)"), Told{"kink at phi = 1: abs(phi - 1)"});
  EXPECT_EQ(placesOf("phi*abs(phi)"), Told{"bend at phi = 0: abs(phi)"});
  EXPECT_EQ(placesOf("sign(phi - 0.5)"), Told{"jump at phi = 0.5: sign(phi - 0.5)"});
  EXPECT_EQ(placesOf("atan2(phi - 0.5, -1)"), Told{"jump at phi = 0.5: atan2(phi - 0.5, -1)"});
  EXPECT_EQ(placesOf("log(abs(phi - 1))"), Told{"pole at phi = 1: log(abs(phi - 1))"});
  EXPECT_EQ(placesOf("tan(phi)"), Told{"pole at phi = 1.57079633: tan(phi)"});
  EXPECT_EQ(placesOf("sin(phi)/phi"), Told{"hole at phi = 0: sin(phi)/phi"});
  EXPECT_EQ(placesOf("sqrt(phi)"), Told{"end at phi = 0: sqrt(phi)"});
  EXPECT_EQ(placesOf("asin(phi)", 0, 2), Told{"end at phi = 1: asin(phi)"});
  EXPECT_EQ(placesOf("sqrt(abs(phi))"), Told{"spike at phi = 0: sqrt(abs(phi))"});
  EXPECT_EQ(placesOf("asin(sin(3*phi))", 0, 1), Told{"kink at phi = 0.523598776: asin(sin(3*phi))"});
  EXPECT_EQ(placesOf("abs(abs(phi) - 1)"),
            (Told{"kink at phi = -1: abs(abs(phi) - 1)", "kink at phi = 0: abs(phi)", "kink at phi = 1: abs(abs(phi) - 1)"}));
}

TEST(Places, WhereAMovementBeginsOrEndsAreNotBetween) {
  EXPECT_EQ(placesOf("abs(phi)", 0, 1), Told{});
  EXPECT_EQ(placesOf("abs(phi)", 1, 0), Told{});
  EXPECT_EQ(placesOf("abs(phi)", 1e-9, -1), Told{"kink at phi = 0: abs(phi)"});
}

// What lies far away has the same places: |r| says nothing of how far apart two sides are.
TEST(Places, AJumpOfCentimetresIsOneAThousandKilometresAway) {
  for (const char* far : {"0", "1e6", "1e8"}) {
    const CurveRegularity r = computeRegularity(typedCurve("phi/10", "0.02*abs(atan2(phi, phi))^2", far), 0.5);
    ASSERT_EQ(r.places.size(), 1u) << far;
    EXPECT_EQ(r.places[0].kind, PlaceKind::Jump) << far;
    EXPECT_EQ(computeRegularity(typedCurve("phi/10", "0.1*sqrt(abs(phi))", far), 0.5).places[0].kind, PlaceKind::Spike) << far;
    EXPECT_EQ(computeRegularity(typedCurve("phi/10", "0.1*abs(phi)", far), 0.5).places[0].kind, PlaceKind::Kink) << far;
    EXPECT_EQ(computeRegularity(typedCurve("phi/10", "0.1*sin(phi)/phi", far), 0.5).places[0].kind, PlaceKind::Hole) << far;
  }
}

TEST(Places, StillPlacesAreToldApart) {
  const auto kindAtZero = [](const std::string& x, const std::string& y) {
    const CurveRegularity r = computeRegularity(typedCurve(x, y), 0.5);
    return r.places.size() == 1 && std::abs(r.places[0].at) < 1e-9 ? nameOf(r.places[0].kind) : "none";
  };
  EXPECT_STREQ(kindAtZero("phi^2", "phi^3"), "cusp");
  EXPECT_STREQ(kindAtZero("phi^2", "phi^4"), "fold");
  EXPECT_STREQ(kindAtZero("phi^3", "phi^3"), "standstill");
  EXPECT_STREQ(kindAtZero("phi^2 + 1e-6*phi", "phi^3"), "none");  // near a cusp is none
}

TEST(Places, WhatOnlyLooksBrokenIsSmooth) {
  for (const char* y : {"sqrt(1 + phi^2)", "1/(2 + sin(phi))", "abs(2 + cos(phi))", "log(1.5 - tanh(phi))", "asin(0.9*sin(phi))", "phi^9",
                        "(2 + cos(phi))^1.5", "atan2(phi, 1 + phi^2)"})
    EXPECT_TRUE(computeRegularity(typedCurve("phi/10", y), 0).whole) << y;
  EXPECT_TRUE(placesOf("cos(atan2(sin(phi), cos(phi)))", -300, 300).empty());
}

TEST(Places, AStraightLineHasNoKinks) {
  EXPECT_TRUE(typedCurve("phi/10", "0.2*phi").straight);
  EXPECT_FALSE(typedCurve("phi/10", "0.05*abs(phi)").straight);
  EXPECT_FALSE(typedCurve("phi/10", "0.05*sign(phi)").straight);
  EXPECT_FALSE(typedCurve("phi/10", "0.1*atan2(sin(phi), cos(phi))").straight);
}

TEST(Places, EveryCurveOfTheCatalogueIsSmoothButForStillPlaces) {
  for (const Definition& d : catalogue()) {
    if (d.kind != ConstraintKind::Curve) continue;
    const Constraint c = makeConstraint(d);
    const CurveRegularity r = computeRegularity(c, d.start[0]);
    EXPECT_TRUE(r.whole) << d.name;
    for (const Place& place : r.places)
      EXPECT_TRUE(place.kind == PlaceKind::Cusp || place.kind == PlaceKind::Fold) << d.name << ": " << describe(place, c.kind);
  }
}

TEST(Places, CuspsOfTheCatalogueAreWhereItsCurvesTurnBack) {
  const auto expect = [](const std::string& name, const std::map<std::string, double>& shape, const std::vector<double>& places) {
    const Constraint c = named(name, shape);
    std::vector<double> found;
    for (const Place& place : computeRegularity(c, 0.4).places)
      if (place.kind == PlaceKind::Cusp && place.at > -0.01 && place.at < 2 * kPi - 0.01) found.push_back(place.at);
    ASSERT_EQ(found.size(), places.size()) << name;
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(found[i], places[i], 1e-9) << name;
  };
  expect("astroid", {}, {0, kPi / 2, kPi, 3 * kPi / 2});
  expect("cardioid", {}, {0});
  expect("nephroid", {}, {0, kPi});
  expect("deltoid", {}, {0, 2 * kPi / 3, 4 * kPi / 3});
  expect("epicycloid", {{"cusps", 5}}, {0, 2 * kPi / 5, 4 * kPi / 5, 6 * kPi / 5, 8 * kPi / 5});
  expect("epitrochoid", {{"d_m", 0.02}, {"a_m", 0.08}}, {0, 2 * kPi / 3, 4 * kPi / 3});
  expect("ellipse", {}, {});
}

// What is shown is true of every point of the range, and of a range that holds an apex, a fold or a ridge nothing is shown.
TEST(Places, ARangeOfASurfaceWithoutAnyIsShownToBeRegular) {
  const auto shown = [](const std::string& x, const std::string& y, const std::string& z, double least, double most) {
    const std::array<Domain, 2> range{Domain{least, most, false}, Domain{0.2, 0.5, false}};
    return isProvedRegular(surface({x, y, z}), range);
  };
  EXPECT_TRUE(shown("(0.1 + 0.04*cos(u))*cos(v)", "(0.1 + 0.04*cos(u))*sin(v)", "0.04*sin(u)", 0.1, 1.5));
  EXPECT_TRUE(shown("u*cos(v)", "u*sin(v)", "u", 0.1, 1));
  EXPECT_FALSE(shown("u*cos(v)", "u*sin(v)", "u", -0.1, 1));
  EXPECT_TRUE(shown("u^2/10", "v/10", "0", 0.1, 1));
  EXPECT_FALSE(shown("u^2/10", "v/10", "0", -0.1, 1));
  EXPECT_TRUE(shown("u/10", "v/10", "abs(u)/10", 0.1, 1));
  EXPECT_FALSE(shown("u/10", "v/10", "abs(u)/10", -0.1, 1));
}

TEST(Places, LinesOfASurfaceAreKnown) {
  const auto branches = [](const std::string& z) { return computeBranches(surface({"u/10", "v/10", z})); };
  EXPECT_TRUE(branches("u^2 + sqrt(1 + v^2)")->smooth());
  const auto roof = branches("abs(u - 0.5)");
  ASSERT_EQ(roof->places.size(), 1u);
  EXPECT_EQ(describe(roof->places[0], ConstraintKind::Surface), "kink at u = 0.5: abs(u - 0.5)");
  EXPECT_EQ(roof->branches.size(), 2u);
  EXPECT_EQ(describe(branches("sqrt(1 - u^2 - v^2)")->places.at(0), ConstraintKind::Surface), "end along 1 - u^2 - v^2 = 0");
}

TEST(Places, AreTheBoundariesOfPiecesThatGoOnBeyondThem) {
  const CurveRegularity r = computeRegularity(typedCurve("phi/10", "abs(phi - 1)/10 + 0.2*abs(phi - 3)"), 0.5);
  ASSERT_EQ(r.places.size(), 2u);
  ASSERT_EQ(r.pieces.size(), 3u);
  EXPECT_FALSE(r.whole || r.smooth);
  EXPECT_NEAR(r.lo, 0.5 - 128 * kPi, 1e-9) << "64 turns either way";
  EXPECT_NEAR(r.hi, 0.5 + 128 * kPi, 1e-9);
  EXPECT_EQ(r.pieces[0].lo, r.lo);
  EXPECT_EQ(r.pieces[2].hi, r.hi);
  for (int i = 0; i < 2; ++i) {
    const CurvePiece &before = r.pieces[i], &after = r.pieces[static_cast<std::size_t>(i) + 1];
    EXPECT_EQ(before.hi, after.lo);
    EXPECT_EQ(before.placeAtHi, i);
    EXPECT_EQ(after.placeAtLo, i);
    EXPECT_TRUE(before.passedAtHi && after.passedAtLo);
  }
  EXPECT_EQ(r.pieces[0].placeAtLo, -1);
  EXPECT_FALSE(r.pieces[0].passedAtLo || r.pieces[2].passedAtHi);
  EXPECT_NEAR(evaluate(r.pieces[0].curve, 4).r.y, -0.3 - 0.2, 1e-15) << "as the formula ran before its kinks";
  EXPECT_NEAR(evaluate(r.pieces[1].curve, 4).r.y, 0.3 - 0.2, 1e-15);
  EXPECT_NEAR(evaluate(r.pieces[2].curve, 0).r.y, -0.1 - 0.6, 1e-15);
  EXPECT_EQ(r.pieceAt(0.9), 0);
  EXPECT_EQ(r.pieceAt(1), 1) << "on a boundary the one above";
  EXPECT_EQ(r.pieceAt(3.1), 2);
  EXPECT_EQ(r.pieceAt(1e6), -1);
  const CurveRegularity slow = computeRegularity(typedCurve("phi/1000", "abs(phi - 1)/1e6"), 0.5);
  EXPECT_NEAR(slow.hi, 0.5 + 10 / std::hypot(1e-3, 1e-6), 1e-6) << "at least 10 m";
}

TEST(Places, ThatNoMassCrossesEndTheirPieces) {
  const CurveRegularity jump = computeRegularity(typedCurve("phi/10", "0.1*sign(phi - 1)"), 0.5);
  ASSERT_EQ(jump.pieces.size(), 2u);
  EXPECT_FALSE(jump.pieces[0].passedAtHi || jump.pieces[1].passedAtLo);
  EXPECT_NEAR(jump.pieces[0].hi, 1, 1e-12);

  const CurveRegularity root = computeRegularity(typedCurve("phi/10", "0.1*sqrt(phi - 1)"), 2);
  ASSERT_EQ(root.pieces.size(), 1u) << "below it has no value";
  const CurvePiece& piece = root.pieces[0];
  EXPECT_EQ(piece.placeAtLo, 0);
  EXPECT_FALSE(piece.passedAtLo);
  EXPECT_GT(piece.lo, 1);
  EXPECT_LT(piece.lo, 1 + 1e-6);
  const CurvePoint at = evaluate(piece.curve, piece.lo), beyond = evaluate(piece.curve, piece.lo - 0.5);
  EXPECT_NEAR(norm(beyond.r - (at.r - 0.5 * at.rPhi)), 0, 1e-9 * norm(at.rPhi)) << "by its tangent";
  EXPECT_EQ(beyond.rPhiPhi, Vec3{});

  const CurveRegularity pole = computeRegularity(typedCurve("phi/10", "0.1/(phi - 1)"), 2);
  ASSERT_EQ(pole.pieces.size(), 2u);
  EXPECT_LT(pole.pieces[0].hi, 1);
  EXPECT_GT(pole.pieces[1].lo, 1);
  EXPECT_LT(pole.pieces[1].lo - pole.pieces[0].hi, 1e-2);
  EXPECT_EQ(pole.pieceAt(1), -1);

  const CurveRegularity hole = computeRegularity(typedCurve("phi/10", "0.1*sin(phi)/phi"), 2);
  ASSERT_EQ(hole.pieces.size(), 2u);
  EXPECT_TRUE(hole.pieces[0].passedAtHi && hole.pieces[1].passedAtLo);
  for (const CurvePiece& one : hole.pieces) EXPECT_NEAR(evaluate(one.curve, 0).r.y, 0.1, 1e-9) << "its limit";
  EXPECT_NEAR(hole.places[0].r.y, 0.1, 1e-9);
}

TEST(Places, WhereACurveComesToRestAreItsFarEnds) {
  const auto ends = [](const std::string& x) {
    std::vector<double> at;
    const CurveRegularity r = computeRegularity(typedCurve(x, "0"), 0);
    EXPECT_TRUE(r.whole) << x;
    for (const Place& place : r.places) {
      if (std::isfinite(place.at)) continue;
      EXPECT_EQ(describe(place, ConstraintKind::Curve),
                std::string("end at phi = ") + (place.at > 0 ? "inf" : "-inf") + ": r comes to rest");
      at.push_back(place.at);
    }
    return at;
  };
  constexpr double kInf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ends("0.1*tanh(phi)"), (std::vector<double>{-kInf, kInf}));
  EXPECT_EQ(ends("0.1*exp(-phi)"), std::vector<double>{kInf});
  EXPECT_EQ(ends("0.1*exp(phi)"), std::vector<double>{-kInf});
  EXPECT_EQ(ends("0.1*phi"), std::vector<double>{});
  EXPECT_EQ(ends("0.1*sin(phi) + 0.2*phi"), std::vector<double>{});
  EXPECT_NEAR(computeRegularity(typedCurve("0.1*tanh(phi) + 1", "2"), 0).places.back().r.x, 1.1, 1e-12);
}

TEST(Places, StillPlacesHaveTheirPointAndGoAlongWithKinks) {
  const CurveRegularity r = computeRegularity(typedCurve("(phi - 1)^2/10", "(phi - 1)^3/10 + 0.1*(abs(phi + 2) - phi - 2)", "5"), 0.5);
  ASSERT_EQ(r.places.size(), 2u) << "in order of phi";
  EXPECT_EQ(describe(r.places[0], ConstraintKind::Curve), "kink at phi = -2: abs(phi + 2)");
  EXPECT_EQ(describe(r.places[1], ConstraintKind::Curve), "cusp at phi = 1: r_phi = 0");
  EXPECT_EQ(r.pieces.at(0).placeAtHi, 0);
  const CurveRegularity still = computeRegularity(typedCurve("(phi - 1)^2/10", "(phi - 1)^3/10", "5"), 0.5);
  ASSERT_EQ(still.places.size(), 1u);
  EXPECT_EQ(describe(still.places[0], ConstraintKind::Curve), "cusp at phi = 1: r_phi = 0");
  EXPECT_EQ(still.places[0].r, (Vec3{0, 0, 5}));
  EXPECT_TRUE(computeRegularityWithin(typedCurve("(phi - 1)^2/10", "(phi - 1)^3/10", "5"), 0, 2).places.empty()) << "not looked for";
}

TEST(Places, OfPiecesAreThoseOfTheWholeListWhicheverComesFirst) {
  const CurveRegularity r = computeRegularity(typedCurve("(phi - 1)^2/10", "(phi - 1)^3/10 + 0.1*(abs(phi - 3) + phi - 3)"), 0.5);
  ASSERT_EQ(r.places.size(), 2u);
  EXPECT_EQ(r.places[0].kind, PlaceKind::Cusp);
  EXPECT_EQ(r.places[1].kind, PlaceKind::Kink);
  EXPECT_EQ(r.pieces.at(0).placeAtHi, 1);
  EXPECT_EQ(r.pieces.at(1).placeAtLo, 1);
}

TEST(Places, WhereACycloidStandsStillAreToldOnFourTurnsEitherWay) {
  const CurveRegularity r = computeRegularity(typedCurve("0.1*(phi - sin(phi))", "0.1*(1 - cos(phi))"), 1);
  EXPECT_TRUE(r.whole);
  ASSERT_EQ(r.places.size(), 8u);
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(r.places[k].at, 2 * kPi * (k - 3), 1e-6);
}

TEST(Places, OfAStretchAreThoseInIt) {
  const Constraint two = typedCurve("phi/10", "abs(phi - 1)/10 + 0.2*abs(phi - 3)");
  const CurveRegularity within = computeRegularityWithin(two, 0, 2);
  EXPECT_EQ(within.lo, 0);
  EXPECT_EQ(within.hi, 2);
  ASSERT_EQ(within.places.size(), 1u);
  EXPECT_EQ(within.places[0].at, 1);
  EXPECT_EQ(within.pieces.size(), 2u);
  EXPECT_TRUE(computeRegularityWithin(two, 1.5, 2.5).whole);
  const Constraint free = named("free");
  EXPECT_TRUE(computeRegularity(free, 0).places.empty());
  EXPECT_TRUE(computeRegularityWithin(free, 0, 1).pieces.empty());
}

std::shared_ptr<const SurfaceBranches> branchesOf(const std::string& z, const std::string& x = "u/10") {
  return computeBranches(surface({x, "v/10", z}));
}
std::vector<std::string> linesOf(const std::string& z) {
  std::vector<std::string> told;
  const auto branches = branchesOf(z);
  for (const Place& place : branches->places) told.push_back(describe(place, ConstraintKind::Surface));
  return told;
}

TEST(SurfaceLines, AreToldByTheirParameterOrTheirEquation) {
  EXPECT_EQ(linesOf("abs(v - 0.25)"), Told{"kink at v = 0.25: abs(v - 0.25)"});
  EXPECT_EQ(linesOf("sign(u - 0.5)"), Told{"jump at u = 0.5: sign(u - 0.5)"});
  EXPECT_EQ(linesOf("1/(v + 0.5)"), Told{"pole at v = -0.5: 1/(v + 0.5)"});
  EXPECT_EQ(linesOf("log(u + 0.5)"), Told{"pole at u = -0.5: log(u + 0.5)"});
  EXPECT_EQ(linesOf("sqrt(v + 0.5)"), Told{"end at v = -0.5: sqrt(v + 0.5)"});
  EXPECT_EQ(linesOf("abs(u + v)"), Told{"kink along u + v = 0"});
  EXPECT_EQ(linesOf("abs(u^2 - 0.25)"), (Told{"kink at u = -0.5: abs(u^2 - 0.25)", "kink at u = 0.5: abs(u^2 - 0.25)"}));
  EXPECT_EQ(linesOf("asin(v)"), (Told{"end at v = 1: asin(v)", "end at v = -1: asin(v)"}));
}

TEST(SurfaceLines, HaveABranchOnEitherSide) {
  const auto two = branchesOf("abs(u - 0.5) + 2*abs(v)");
  ASSERT_EQ(two->lines.size(), 2u);
  ASSERT_EQ(two->branches.size(), 4u);
  for (const auto& line : two->lines) EXPECT_TRUE(line.passable);
  EXPECT_FALSE(two->smooth());
  for (int index = 0; index < 4; ++index) {
    const auto side = [&](int line) { return (index >> two->lines[line].bit & 1) != 0 ? 1.0 : -1.0; };
    const bool first = two->lines[0].because == "abs(u - 0.5)";
    const double z = side(first ? 0 : 1) * (0.3 - 0.5) + 2 * side(first ? 1 : 0) * 0.7;
    const SurfacePoint p = evaluate(two->branches[index], 0.3, 0.7);
    EXPECT_NEAR(p.r.z, z, 1e-15) << index;
    EXPECT_EQ(p.rU.x, 0.1);
  }
  const auto at = two->at(0.3, 0.7);
  const std::size_t u = two->lines[0].because == "abs(u - 0.5)" ? 0 : 1;
  EXPECT_NEAR(at[u].value, -0.2, 1e-15);
  EXPECT_EQ(at[u].u, 1);
  EXPECT_EQ(at[u].v, 0);
  EXPECT_NEAR(at[1 - u].value, 0.7, 1e-15);
  EXPECT_EQ(at[1 - u].u, 0);
  EXPECT_EQ(at[1 - u].v, 1);
  for (std::size_t k = 2; k < at.size(); ++k) EXPECT_EQ(at[k].value, 1) << "no line is met";
  const auto arc = branchesOf("asin(v)");
  EXPECT_EQ(arc->lines[0].level, 1);
  EXPECT_NEAR(arc->at(0.2, 0.75)[0].value, -0.25, 1e-15);
  EXPECT_EQ(arc->branches.size(), 1u);
  EXPECT_FALSE(arc->lines[0].passable);
  EXPECT_EQ(arc->lines[0].bit, -1);
}

TEST(SurfaceLines, AreSixAtMostAndFourToBePassed) {
  std::string sum = "0";
  for (int k = 1; k <= 6; ++k) sum += "+abs(u - 0.1*" + std::to_string(k) + ")";
  const auto six = branchesOf(sum);
  ASSERT_EQ(six->lines.size(), 6u);
  EXPECT_EQ(std::count_if(six->lines.begin(), six->lines.end(), [](const auto& line) { return line.passable; }), 4);
  EXPECT_EQ(six->branches.size(), 16u);
  EXPECT_NEAR(evaluate(six->branches[15], 2, 0).r.z, 12 - 2.1, 1e-14) << "above all of them";
  EXPECT_EQ(refusalOf([&] { (void)branchesOf(sum + "+abs(v)"); }),
            "the surface's formula has 7 operations that are not smooth everywhere (abs, sign, roots, quotients …); allowed: 6");
}

TEST(SurfaceLines, AreNoneWhereTheFormulaIsSmooth) {
  for (const char* smooth : {"u*v", "sqrt(1 + u^2)", "abs(2 + sin(u*v))", "atan2(v, 2 + u^2)", "1/(1.5 + cos(v))", "asin(0.9*sin(u))"})
    EXPECT_TRUE(branchesOf(smooth)->smooth()) << smooth;
  EXPECT_TRUE(computeBranches(named("free"))->smooth());
  EXPECT_EQ(branchesOf("atan2(u, v)")->lines[0].kind, PlaceKind::Jump);
  EXPECT_TRUE(branchesOf("tan(u)")->places.empty()) << "outside of the stretch that is told of";
  EXPECT_EQ(branchesOf("tan(u)")->lines[0].kind, PlaceKind::Pole);
}

}  // namespace
}  // namespace reachlab::constraints
