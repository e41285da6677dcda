#include <gtest/gtest.h>

#include <cmath>

#include "constraints/curve_batch.h"
#include "constraints/regularity/hidden_bend.h"
#include "constraints/regularity/narrow_band.h"
#include "constraints/regularity/places.h"

/// What is so narrow on a curve or a surface that a movement could step over it.
namespace reachlab::constraints {
namespace {

Constraint surface(const std::string& z, const std::string& x = "u", const std::string& y = "v") {
  return makeConstraint({.name = {}, .curve = {}, .surface = {x, y, z}, .shape = {}});
}
Constraint named(const char* name) { return makeConstraint({.name = name, .curve = {}, .surface = {}, .shape = {}}); }

// 1e-5 wide about 0.31: seen along the parameter line through the start, and along no other.
TEST(NarrowBand, IsFoundOnTheLinesThroughTheStart) {
  for (const int k : {0, 1}) {
    const std::string q = k == 0 ? "u" : "v";
    const auto band = findNarrowBand(surface(std::string("1e-6*exp(-((").append(q).append(" - 0.31)/1e-5)^2)")), {0.1, -0.2});
    ASSERT_TRUE(band) << q;
    EXPECT_EQ(band->parameter, k);
    EXPECT_NEAR(band->at, 0.31, 2e-5);
    EXPECT_GT(band->width, 1e-6);
    EXPECT_LT(band->width, 1e-4);
  }
  for (const char* near : {"-7.8", "8.0"}) {
    const std::string bump = std::string("1e-6*exp(-((u - (") + near + "))/1e-5)^2)";
    EXPECT_TRUE(findNarrowBand(surface(bump), {0.1, -0.2})) << near << ": within eight units";
  }
  for (const char* far : {"-8.0", "8.2"}) {
    const std::string bump = std::string("1e-6*exp(-((u - (") + far + "))/1e-5)^2)";
    EXPECT_FALSE(findNarrowBand(surface(bump), {0.1, -0.2})) << far;
  }
}

TEST(NarrowBand, IsNoneOnWhatBendsAsItDoesElsewhere) {
  EXPECT_FALSE(findNarrowBand(surface("u*v"), {0, 0}));
  EXPECT_FALSE(findNarrowBand(surface("sin(3*u) + cos(2*v)"), {0.1, 0.2}));
  EXPECT_FALSE(findNarrowBand(surface("0.01*exp(-((u - 0.3)/0.02)^2)"), {0, 0})) << "wide enough to be seen";
  EXPECT_FALSE(findNarrowBand(named("gaussian-hill"), {0, 0})) << "the catalogue is known";
  EXPECT_FALSE(findNarrowBand(surface("sqrt(-1 - u^2)"), {0, 0})) << "nothing is there";
}

/// A straight way over u = share, v = 0.2 + 0.5 share.
WayPoint straight(double share) { return {{share, 0.2 + 0.5 * share}, {1, 0.5}, {0.3, 0.2}}; }

TEST(HiddenBend, IsFoundBetweenTheSamples) {
  for (const char* bump : {"1e-9*exp(-((u - 0.4003)/1e-5)^2)", "1e-9*exp(-((v - 0.40015)/5e-6)^2)"}) {
    const auto hidden = findHiddenBend(surface(bump), straight, 1e-3);
    ASSERT_TRUE(hidden) << bump;
    EXPECT_TRUE(hidden->found);
    EXPECT_NEAR(hidden->at[0], 0.4003, 1e-4) << bump;
    EXPECT_NEAR(hidden->at[1], 0.2 + 0.5 * hidden->at[0], 1e-12) << "on the way";
  }
  EXPECT_TRUE(findHiddenBend(surface("u*v + 1e-9*exp(-((u - v - 0.10015)/1e-5)^2)"), straight, 1e-3)) << "across both";
}

TEST(HiddenBend, IsNoneWhereTheSamplesTellAll) {
  EXPECT_FALSE(findHiddenBend(surface("sin(3*u)*cos(2*v)"), straight, 1e-3));
  EXPECT_FALSE(findHiddenBend(surface("u*v + u^3 - v^2"), straight, 1e-3));
  EXPECT_FALSE(findHiddenBend(surface("u + v"), straight, 0)) << "a plane has none at all";
  EXPECT_FALSE(findHiddenBend(surface("1e-9*exp(-((u - 0.4003)/1e-5)^2)"), straight, 1e9)) << "less than what matters";
  EXPECT_FALSE(findHiddenBend(named("gaussian-hill"), straight, 1e-3)) << "the catalogue is known";
  EXPECT_FALSE(findHiddenBend(surface("1e-9*exp(-((u - 3)/1e-5)^2)"), straight, 1e-3)) << "not on the way";
}

TEST(HiddenBend, IsNotToldAwayWhereNothingIsKnown) {
  const auto edge = findHiddenBend(surface("sqrt(0.5003 - u)"), straight, 1e-3);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->at[0], 0.5003, 2e-3) << "the slope grows without bound";
}

// Of r(phi) = (phi, 2 phi^2, 3) and its derivatives, each in its lane.
TEST(CurveBatch, HoldsEachPointInItsLane) {
  const auto point = [](const void*, const double* shape, double phi, CurvePoint& out) noexcept {
    out = {{phi, shape[0] * phi * phi, 3}, {1, 2 * shape[0] * phi, 0.5}, {0.25, 2 * shape[0], phi + 1}};
  };
  const double two = 2;
  double phis[kBatchLanes];
  for (int i = 0; i < kBatchLanes; ++i) phis[i] = 0.5 * i - 1;
  CurveBatch batch;
  evaluateSingly(point, nullptr, &two, phis, batch);
  for (int i = 0; i < kBatchLanes; ++i) {
    CurvePoint expected;
    point(nullptr, &two, phis[i], expected);
    EXPECT_EQ((Vec3{batch.r[0][i], batch.r[1][i], batch.r[2][i]}), expected.r) << i;
    EXPECT_EQ((Vec3{batch.rPhi[0][i], batch.rPhi[1][i], batch.rPhi[2][i]}), expected.rPhi) << i;
    EXPECT_EQ((Vec3{batch.rPhiPhi[0][i], batch.rPhiPhi[1][i], batch.rPhiPhi[2][i]}), expected.rPhiPhi) << i;
  }
}

// 30 times the usual bend on less than 2 mm: a piece of its own, a quarter wider either way, that a mass goes through.
TEST(NarrowPiece, OfACurveStandsOnItsOwn) {
  const Constraint bumped =
      makeConstraint({.name = {}, .curve = {"phi/10", "1e-5*exp(-((phi - 1)/1e-3)^2)", "0"}, .surface = {}, .shape = {}});
  const CurveRegularity r = computeRegularity(bumped, 0.5);
  EXPECT_TRUE(r.smooth);
  EXPECT_FALSE(r.whole);
  ASSERT_EQ(r.pieces.size(), 3u);
  EXPECT_FALSE(r.pieces[0].narrow || r.pieces[2].narrow);
  EXPECT_TRUE(r.pieces[1].narrow);
  EXPECT_LT(r.pieces[1].lo, 1 - 5e-4);
  EXPECT_GT(r.pieces[1].lo, 1 - 1e-2);
  EXPECT_NEAR(r.pieces[1].lo + r.pieces[1].hi, 2, 1e-6) << "even about its middle";
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(r.pieces[i].hi, r.pieces[i + 1].lo);
    EXPECT_TRUE(r.pieces[i].passedAtHi && r.pieces[i + 1].passedAtLo);
    EXPECT_EQ(r.pieces[i].placeAtHi, -1);
    EXPECT_EQ(r.pieces[i + 1].placeAtLo, -1);
  }
  EXPECT_EQ(r.pieceAt(1), 1);
  EXPECT_EQ(evaluate(r.pieces[1].curve, 1.0003).r.y, evaluate(bumped.curve, 1.0003).r.y);
  const Constraint two = makeConstraint(
      {.name = {}, .curve = {"phi/10", "1e-5*exp(-((phi - 1)/1e-3)^2) + 1e-5*exp(-((phi - 2)/1e-3)^2)", "0"}, .surface = {}, .shape = {}});
  EXPECT_EQ(computeRegularity(two, 0.5).pieces.size(), 5u);
  const Constraint wide =
      makeConstraint({.name = {}, .curve = {"phi/10", "1e-2*exp(-((phi - 1)/0.1)^2)", "0"}, .surface = {}, .shape = {}});
  EXPECT_TRUE(computeRegularity(wide, 0.5).whole);
}

}  // namespace
}  // namespace reachlab::constraints
