#include "constraints/places.h"

#include <gtest/gtest.h>

#include <numbers>

#include "constraints/definition.h"
#include "constraints/surface_branches.h"

namespace reachlab::constraints {
namespace {

constexpr double kPi = std::numbers::pi;

Constraint curve(const std::string& x, const std::string& y, const std::string& z = "0") {
  return makeConstraint({.name = {}, .curve = {x, y, z}, .surface = {}, .shape = {}});
}
std::vector<std::string> placesOf(const std::string& y, double from = -1.01, double to = 2.02) {
  std::vector<std::string> told;
  for (const Place& place : placesBetween(computeRegularity(curve("phi/10", y), 0.4), from, to))
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
    const CurveRegularity r = computeRegularity(curve("phi/10", "0.02*abs(atan2(phi, phi))^2", far), 0.5);
    ASSERT_EQ(r.places.size(), 1u) << far;
    EXPECT_EQ(r.places[0].kind, PlaceKind::Jump) << far;
    EXPECT_EQ(computeRegularity(curve("phi/10", "0.1*sqrt(abs(phi))", far), 0.5).places[0].kind, PlaceKind::Spike) << far;
    EXPECT_EQ(computeRegularity(curve("phi/10", "0.1*abs(phi)", far), 0.5).places[0].kind, PlaceKind::Kink) << far;
    EXPECT_EQ(computeRegularity(curve("phi/10", "0.1*sin(phi)/phi", far), 0.5).places[0].kind, PlaceKind::Hole) << far;
  }
}

TEST(Places, StillPlacesAreToldApart) {
  const auto kindAtZero = [](const std::string& x, const std::string& y) {
    const CurveRegularity r = computeRegularity(curve(x, y), 0.5);
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
    EXPECT_TRUE(computeRegularity(curve("phi/10", y), 0).whole) << y;
  EXPECT_TRUE(placesOf("cos(atan2(sin(phi), cos(phi)))", -300, 300).empty());
}

TEST(Places, AStraightLineHasNoKinks) {
  EXPECT_TRUE(curve("phi/10", "0.2*phi").straight);
  EXPECT_FALSE(curve("phi/10", "0.05*abs(phi)").straight);
  EXPECT_FALSE(curve("phi/10", "0.05*sign(phi)").straight);
  EXPECT_FALSE(curve("phi/10", "0.1*atan2(sin(phi), cos(phi))").straight);
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

// What is shown is true of every point of the range, and of a range that holds an apex, a fold or a ridge nothing is shown.
TEST(Places, ARangeOfASurfaceWithoutAnyIsShownToBeRegular) {
  const auto shown = [](const std::string& x, const std::string& y, const std::string& z, double least, double most) {
    const std::array<Domain, 2> range{Domain{least, most, false}, Domain{0.2, 0.5, false}};
    return isProvedRegular(makeConstraint({.name = {}, .curve = {}, .surface = {x, y, z}, .shape = {}}), range);
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
  const auto branches = [](const std::string& z) {
    return computeBranches(makeConstraint({.name = {}, .curve = {}, .surface = {"u/10", "v/10", z}, .shape = {}}));
  };
  EXPECT_TRUE(branches("u^2 + sqrt(1 + v^2)")->smooth());
  const auto roof = branches("abs(u - 0.5)");
  ASSERT_EQ(roof->places.size(), 1u);
  EXPECT_EQ(describe(roof->places[0], ConstraintKind::Surface), "kink at u = 0.5: abs(u - 0.5)");
  EXPECT_EQ(roof->branches.size(), 2u);
  EXPECT_EQ(describe(branches("sqrt(1 - u^2 - v^2)")->places.at(0), ConstraintKind::Surface), "end along 1 - u^2 - v^2 = 0");
}

}  // namespace
}  // namespace reachlab::constraints
