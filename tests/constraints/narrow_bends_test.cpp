#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "constraints/regularity/hidden_bend.h"
#include "constraints/regularity/places.h"
#include "constraints/regularity/surface_watch.h"
#include "tests/constraints/made_constraints.h"

/// What is so narrow on a curve or a surface that a movement could step over it.
namespace reachlab::constraints {
namespace {

Constraint graphOf(const std::string& z) { return surface({"u", "v", z}); }

SurfaceWatch::Motion motion(double u, double v, double uRate, double vRate) {
  return {{u, v}, {uRate, vRate}, {}, {1, 1}, std::hypot(uRate, vRate)};
}

// A ridge 1e-5 wide, in a surface of metres: no step of a millisecond may lead across it, however it is met.
TEST(SurfaceWatch, SeesARidgeOnTheWayWhereverItLies) {
  for (const double ridge : {0.31, -7.8, 120.0})
    for (const char* q : {"u", "v", "u + v"}) {
      const auto watch = SurfaceWatch::make(graphOf(fmt::format("1e-6*exp(-(({} - {})/1e-5)^2)", q, ridge)));
      const double u = q == std::string("v") ? 0 : ridge - 1.0003e-4, v = q == std::string("v") ? ridge - 1.0003e-4 : 0;
      const SurfaceWatch::Motion towards = motion(u, v, 0.4, 0.4), away = motion(u - 1e-3, v - 1e-3, -0.4, -0.4);
      EXPECT_FALSE(watch->allows(towards, 1e-3)) << q << " " << ridge;
      EXPECT_TRUE(watch->allows(away, 1e-3)) << q << " " << ridge;
      const double reach = watch->reach(towards, 1e-3);
      EXPECT_GT(reach, 1e-6);
      EXPECT_LT(0.4 * reach, 1.2e-4) << "it ends in the ridge at the latest";
    }
}

TEST(SurfaceWatch, AllowsStepsOverWhatBendsGently) {
  for (const char* z : {"u*v", "sin(3*u) + cos(2*v)", "0.01*exp(-((u - 0.3)/0.05)^2)", "sqrt(1 + u^2)", "0.1*abs(u)"}) {
    const auto watch = SurfaceWatch::make(graphOf(z));
    for (double u = -1; u < 1; u += 0.0137) EXPECT_TRUE(watch->allows(motion(u, 0.2, 0.4, -0.3), 1e-3)) << z << " " << u;
  }
  EXPECT_EQ(SurfaceWatch::make(named("gaussian-hill")), nullptr) << "the catalogue is known";
}

// What was learnt about some ticks ahead holds for no other place and no faster motion.
TEST(SurfaceWatch, KnowsOnlyWhereItLooked) {
  const auto watch = SurfaceWatch::make(graphOf("1e-6*exp(-((u - 0.31)/1e-5)^2)"));
  ASSERT_TRUE(watch->allows(motion(0, 0, 0.4, 0), 1e-3));
  EXPECT_TRUE(watch->knows({0.001, 0}, {0.4, 0}, 1e-3));
  EXPECT_FALSE(watch->knows({0.31, 0}, {0.4, 0}, 1e-3));
  EXPECT_FALSE(watch->knows({0.001, 0}, {4, 0}, 1e-3));
  EXPECT_FALSE(watch->knows({0.001, 0}, {0.4, 0}, 2e-3));
}

/// A straight way over u = share, v = 0.2 + 0.5 share.
WayPoint straight(double share) { return {{share, 0.2 + 0.5 * share}, {1, 0.5}, {0.3, 0.2}}; }

TEST(HiddenBend, IsFoundBetweenTheSamples) {
  for (const char* bump : {"1e-9*exp(-((u - 0.4003)/1e-5)^2)", "1e-9*exp(-((v - 0.40015)/5e-6)^2)"}) {
    const auto hidden = findHiddenBend(graphOf(bump), straight, 1e-3);
    ASSERT_TRUE(hidden) << bump;
    EXPECT_TRUE(hidden->found);
    EXPECT_NEAR(hidden->at[0], 0.4003, 1e-4) << bump;
    EXPECT_NEAR(hidden->at[1], 0.2 + 0.5 * hidden->at[0], 1e-12) << "on the way";
  }
  EXPECT_TRUE(findHiddenBend(graphOf("u*v + 1e-9*exp(-((u - v - 0.10015)/1e-5)^2)"), straight, 1e-3)) << "across both";
}

TEST(HiddenBend, IsNoneWhereTheSamplesTellAll) {
  EXPECT_FALSE(findHiddenBend(graphOf("sin(3*u)*cos(2*v)"), straight, 1e-3));
  EXPECT_FALSE(findHiddenBend(graphOf("u*v + u^3 - v^2"), straight, 1e-3));
  EXPECT_FALSE(findHiddenBend(graphOf("u + v"), straight, 0)) << "a plane has none at all";
  EXPECT_FALSE(findHiddenBend(graphOf("1e-9*exp(-((u - 0.4003)/1e-5)^2)"), straight, 1e9)) << "less than what matters";
  EXPECT_FALSE(findHiddenBend(named("gaussian-hill"), straight, 1e-3)) << "the catalogue is known";
  EXPECT_FALSE(findHiddenBend(graphOf("1e-9*exp(-((u - 3)/1e-5)^2)"), straight, 1e-3)) << "not on the way";
}

TEST(HiddenBend, IsNotToldAwayWhereNothingIsKnown) {
  const auto edge = findHiddenBend(graphOf("sqrt(0.5003 - u)"), straight, 1e-3);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->at[0], 0.5003, 2e-3) << "the slope grows without bound";
}

CurveRegularity bumpsOn(const std::string& y) { return computeRegularity(curve({"phi/10", y, "0"}), 0.5); }

// Narrow is what a step of 1 mm could miss. A step may lead up to the place, and into it by a part of its width.
TEST(NarrowPlace, OfACurveIsSeenFromBothSides) {
  const CurveRegularity r = bumpsOn("1e-5*exp(-((phi - 1)/1e-3)^2)");
  EXPECT_TRUE(r.smooth);
  EXPECT_FALSE(r.whole);
  EXPECT_EQ(r.pieces.size(), 1u);
  ASSERT_FALSE(r.narrow.empty());
  for (const NarrowPlace& place : r.narrow) {
    EXPECT_GT(place.lo, 1 - 0.02);
    EXPECT_LT(place.hi, 1 + 0.02);
    EXPECT_LT(place.reach, 0.01);
  }
  EXPECT_LT(r.reachFrom(1, true), 1e-3);
  EXPECT_LT(r.reachFrom(1, false), 1e-3);
  EXPECT_GT(r.reachFrom(1, true), 1e-5);
  EXPECT_LT(r.reachFrom(0.5, true), 0.505);
  EXPECT_GT(r.reachFrom(0.5, true), 0.49);
  EXPECT_TRUE(std::isinf(r.reachFrom(0.5, false)));
  EXPECT_TRUE(std::isinf(r.reachFrom(1.5, true)));
  EXPECT_TRUE(bumpsOn("1e-2*exp(-((phi - 1)/0.3)^2)").whole) << "wide";
}

// There is no largest number of them, and none is hidden among others, in a cosine or behind many turns.
TEST(NarrowPlace, IsFoundInACosineAmongManyAndFarAway) {
  const CurveRegularity cosine = bumpsOn("1e-6/(1 + 1e10*(cos(phi) - 0.5)^2)");
  for (const double turn : {-10.0, 0.0, 1.0, 10.0}) {
    const double at = std::acos(0.5) + turn * 2 * std::acos(-1.0);
    EXPECT_LT(cosine.reachFrom(at, true), 1e-4) << turn;
  }
  EXPECT_LT(bumpsOn("1e-6*exp(-(1e5*(phi - 300))^2)").reachFrom(300, true), 1e-4);
  const CurveRegularity ripples = bumpsOn("1e-5*sin(1e5*phi)");
  for (const double at : {-200.0, -0.3, 0.0, 7.123, 399.0}) {
    EXPECT_LT(ripples.reachFrom(at, true), 2e-5) << at;
    EXPECT_GT(ripples.reachFrom(at, true), 1e-6) << at;
  }
}

// Where the search ends, motion ends: infinitely many wiggles are not called smooth.
TEST(NarrowPlace, NothingIsSaidOfWhatWasNotSearched) {
  EXPECT_TRUE(std::isinf(bumpsOn("0.1*cos(phi) + 0.02*sin(7*phi)").seenHi)) << "repeats itself";
  EXPECT_TRUE(std::isinf(bumpsOn("0.01*phi^3").seenHi)) << "bends nowhere shortly";
  const CurveRegularity chirp = bumpsOn("1e-3*sin(exp(phi/10))");
  EXPECT_TRUE(std::isfinite(chirp.seenHi));
  EXPECT_EQ(chirp.pieces.back().hi, chirp.seenHi);
  EXPECT_FALSE(chirp.pieces.back().passedAtHi);
}

}  // namespace
}  // namespace reachlab::constraints
