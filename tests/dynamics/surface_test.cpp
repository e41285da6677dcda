#include <gtest/gtest.h>

#include "constraints/constraint.h"
#include "sim/dynamics/compile.h"
#include "sim/dynamics/rk4_error.h"
#include "sim/dynamics/systems/quadric.h"
#include "sim/experiment/experiment.h"
#include "tests/constraints/made_constraints.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

using experiment::Experiment;
using experiment::ObjectKind;

ObjectModel held() {
  ObjectModel m;
  m.mass = {0.7};
  m.handStiffness = {300}, m.handDamping = {4};
  m.viscosity = 0.6;
  m.gravity = {0.5, -1.2, -0.8};
  return m;
}

/// One surface of second degree, in its own parameters and in world coordinates.
struct Both {
  constraints::Constraint constraint;
  std::unique_ptr<Plant> chart, world;
  Both(const ObjectModel& model, const constraints::Constraint& c, bool edges, const char* method = "adaptive") : constraint(c) {
    chart = makeChartPlant(model, c, nullptr, {method, 0});
    world = makeQuadricPlant(model, c, *fitQuadric(c.surface, c.domain, {0.3, 0.2}), edges, {method, 0});
  }
  template <class Act>
  void each(const Act& act) {
    act(*chart), act(*world);
  }
  void expectSame(const HandSample& hand, double within) const {
    const MassState a = observed(*chart, hand)[0], b = observed(*world, hand)[0];
    EXPECT_LT(norm(a.r - b.r), within);
    EXPECT_LT(norm(a.v - b.v), 100 * within);
    EXPECT_LT(norm(a.a - b.a), 1e4 * within);
    EXPECT_LT(norm(constraints::evaluate(constraint.surface, b.q[0], b.q[1]).r - b.r), 1e-12) << "its parameters are those of its place";
    for (const std::size_t k : {0u, 1u}) {
      EXPECT_NEAR(a.q[k], b.q[k], 100 * within);
      EXPECT_NEAR(a.qRate[k], b.qRate[k], 1e4 * within);
    }
    EXPECT_LT(norm(chart->couplingForce(hand) - world->couplingForce(hand)), 1e4 * within);
    EXPECT_NEAR(chart->energy(hand), world->energy(hand), 1e4 * within);
  }
};

TEST(Surface, OfSecondDegreeIsTheSameInItsParametersAndInTheWorld) {
  for (const auto& [x, y, z] : {std::tuple{"0.1*cos(u)*cos(v)", "0.08*sin(u)*cos(v)", "0.06*sin(v)"},
                                {"0.1*cos(u)*cos(v)", "0.1*sin(u)*cos(v)", "0.1*sin(v)"},
                                {"0.1*u + 0.05*v", "0.1*v + 0.3", "0.05*u*v + 0.02*u"},
                                {"0.1*cosh(v)*cos(u)", "0.1*cosh(v)*sin(u)", "0.08*sinh(v)"},
                                {"0.1*cos(u)", "0.07*sin(u) + 0.02*cos(u)", "0.1*v"}})
    for (const char* method : {"adaptive", "abm"}) {
      SCOPED_TRACE(testing::Message() << x << ", " << y << ", " << z << " by " << method);
      Both both(held(), constraints::surface({x, y, z}), false, method);
      const HandFunction hand = [](double t) {
        return HandSample{{0.12 - 0.1 * t, 0.1 * std::sin(3 * t), 0.05 + 0.2 * t}, {-0.1, 0.3 * std::cos(3 * t), 0.2}, true};
      };
      both.each([](Plant& p) { p.place(std::array{0.3, 0.2}, std::array{2.0, -1.5}); });
      both.expectSame(hand(0), 1e-13);
      both.each([](Plant& p) { p.setExtraForce({0.5, -0.3, 0.4}); });
      both.each([&](Plant& p) { ASSERT_EQ(run(p, hand, 0.15), StepStatus::Ok); });
      both.expectSame(hand(0.15), 2e-10);
      both.each([](Plant& p) { p.setCoupled(false); });
      both.each([&](Plant& p) { ASSERT_EQ(run(p, hand, 0.1), StepStatus::Ok); });
      both.expectSame(hand(0.1), 1e-9);
    }
}

constraints::Constraint patch(constraints::AtEnd atEnd) {
  constraints::Constraint c = constraints::surface({"0.1*u + 0.03*v", "0.1*v", "0.05*u*v + 0.02*u^2"});
  c.domain = {constraints::Domain{-1, 0.8, false, atEnd}, constraints::Domain{-0.6, 0.9, false, atEnd}};
  return c;
}

// Each of the four edges, whose parameter lines meet the others aslant.
TEST(Surface, AnEdgeIsMetAtTheSameMomentInBothForms) {
  for (const std::array rate : {std::array{3.0, 0.4}, {-3.0, 0.4}, {0.4, 3.0}, {-0.4, -3.0}}) {
    ObjectModel alone = held();
    alone.gravity = {};
    Both both(alone, patch(constraints::AtEnd::Stop), true);
    both.each([&](Plant& p) {
      p.setCoupled(false);
      p.place(std::array{0.1, 0.1}, rate);
      EXPECT_EQ(p.stopReason(), "");
      EXPECT_EQ(run(p, noHand, 1), StepStatus::AtEnd);
      EXPECT_EQ(p.stopReason().substr(p.stopReason().find("reached")), "reached the end of the constraint's domain");
      const MassState mass = observed(p)[0];
      const bool u = std::abs(rate[0]) > 1;
      EXPECT_NEAR(mass.q[u ? 0 : 1], u ? (rate[0] > 0 ? 0.8 : -1) : (rate[1] > 0 ? 0.9 : -0.6), 1e-11);
    });
    EXPECT_NEAR(both.chart->lastStepFraction(), both.world->lastStepFraction(), 1e-6);
    both.expectSame({}, 1e-9);
  }
}

// Ends are looked for only where a mass may have met one.
TEST(Surface, WithinItsEdgesATickCostsWhatItCostsWithoutThem) {
  const auto spent = [](bool ended) {
    constraints::Constraint c = patch(constraints::AtEnd::Bounce);
    if (!ended) c.domain = {};
    const auto plant = makeChartPlant(held(), c, nullptr, {"abm", 0});
    plant->place(std::array{0.1, 0.1}, std::array{0.2, -0.1});
    EXPECT_EQ(run(*plant, HandSample{{0.01, 0.01, 0}, {}, true}, 0.3), StepStatus::Ok);
    return plant->rhsEvaluations();
  };
  EXPECT_EQ(spent(true), spent(false));
}

TEST(Surface, ElasticEdgesThrowAMassBackAlikeInBothForms) {
  ObjectModel alone = held();
  alone.viscosity = 0;
  Both both(alone, patch(constraints::AtEnd::Bounce), true);
  int turns = 0;
  both.each([](Plant& p) {
    p.setCoupled(false);
    p.place(std::array{0.1, 0.1}, std::array{5.0, 4.0});
  });
  const double before = both.chart->energy({});
  double last = 1;
  for (int tick = 0; tick < 1200; ++tick) {
    both.each([](Plant& p) { ASSERT_EQ(p.step({}, 1e-3), StepStatus::Ok); });
    const double rate = observed(*both.chart)[0].qRate[0];
    turns += rate * last < 0;
    last = rate;
  }
  EXPECT_GT(turns, 2);
  both.expectSame({}, 1e-7);
  both.each([&](Plant& p) { EXPECT_NEAR(p.energy({}), before, 1e-10); });
}

// Far from where the parameters were known last the nearest place of the surface is looked for.
TEST(Surface, WhoLooksSeldomIsToldTheParametersAsWell) {
  const constraints::Constraint c = constraints::surface({"0.1*cos(u)*cos(v)", "0.08*sin(u)*cos(v)", "0.06*sin(v)"});
  Both both(held(), c, false);
  both.each([](Plant& p) {
    p.setCoupled(false);
    p.place(std::array{0.3, 0.2}, std::array{6.0, 2.0});
  });
  for (const double seconds : {0.4, 0.9, 0.25, 1.3}) {
    ASSERT_EQ(run(*both.world, noHand, seconds), StepStatus::Ok);
    const MassState mass = observed(*both.world)[0];
    const constraints::SurfacePoint p = constraints::evaluate(c.surface, mass.q[0], mass.q[1]);
    EXPECT_LT(norm(p.r - mass.r), 1e-12) << seconds;
    EXPECT_LT(norm(mass.qRate[0] * p.rU + mass.qRate[1] * p.rV - mass.v), 1e-9) << seconds;
  }
}

// --- what ends a motion

std::string stopped(const Experiment& e, const std::vector<double>& q, const std::vector<double>& rate, StepStatus expected) {
  const Scene scene = freeScene(e, q, rate);
  EXPECT_EQ(run(*scene.plant, noHand, 2), expected) << scene.choice.form;
  EXPECT_EQ(scene.plant->lastStepFraction() == 0, expected == StepStatus::NoContinuation) << "the state is that before the step";
  return scene.plant->stopReason();
}

TEST(Surface, WhatEndsAMotionIsToldInWords) {
  EXPECT_TRUE(holds(stopped(onSurface("v*cos(u)/10", "v*sin(u)/10", "v/10"), {0.4, 0.5}, {0, -1}, StepStatus::NoContinuation),
                    "the surface has no tangent plane here (a cone's apex)"));
  const std::string jump = stopped(onSurface("u/10", "v/10", "0.02*sign(u - 0.5) + 0.01*v^3"), {0.2, 0.1}, {1, 0.1}, StepStatus::AtEnd);
  EXPECT_TRUE(holds(jump, "the mass met a place of the surface that is never crossed: jump"));
  const std::string parallel =
      stopped(onSurface("0.1*(u + v)", "0.1*log(cosh(u - v))", "0.01*(u + v)^3"), {0.05, -0.05}, {-0.03, 0.03}, StepStatus::NoContinuation);
  EXPECT_TRUE(holds(parallel, "the surface's parameter lines run into each other here"));
  EXPECT_TRUE(holds(parallel, " degrees apart"));
  const std::string pinch = stopped(onSurface("u*v", "u", "v^2"), {0, 0.3}, {0, -1}, StepStatus::NoContinuation);
  EXPECT_TRUE(holds(pinch, "the surface degenerates here (a pinch point, an apex or a cuspidal edge)"));
}

// A constant force drives a mass up a monkey saddle, until its slope is 19000 and its parameter lines are 0.007 degrees apart. The reference
// is a Taylor series of 28 digits of the motion of (x, y) on z = 50 (x^3 - 3 x y^2).
TEST(Surface, WhereParameterLinesRunTogetherTheMotionKeepsItsDigits) {
  Experiment e = onSurface("u/10", "v/10", "0.05*(u^3 - 3*u*v^2)");
  e.object.gravity = {0.3, 0.7, 2};
  const Scene scene = freeScene(e, {0.3, 0.2}, {0, 0});
  ASSERT_EQ(run(*scene.plant, noHand, 6), StepStatus::Ok);
  const MassState mass = observed(*scene.plant)[0];
  const Vec3 r{9.7421409578112859, 5.6227107028736153, 31.507787385711941}, v{3.2128061051952977, 1.8554962848130288, 11.222256438391633};
  EXPECT_LT(norm(mass.r - r), 1e-11 * norm(r));
  EXPECT_LT(norm(mass.v - v), 1e-11 * norm(v));
}

// sqrt(u) ends at u = 0 with |r_u| without bound: the mass stays beside it.
TEST(Surface, BesideAnEndOfItsFormulaAMassIsStopped) {
  const std::string words = stopped(onSurface("u/10", "v/10", "0.05*sqrt(u) + 0.01*v^3"), {0.3, 0.1}, {-1, 0.1}, StepStatus::AtEnd);
  EXPECT_TRUE(holds(words, "the mass is beside a place of the surface that is never crossed: "));
  EXPECT_TRUE(holds(words, "nearer, the formula loses the digits of the speed"));
}

// Two planes that meet in a crease at 45 degrees and less: what is along it stays, and the speed.
TEST(Surface, OverACreaseAMassGoesOnStraightAsOnAFoldedSheet) {
  const Scene scene = freeScene(onSurface("0.1*u", "0.1*v", "0.1*abs(u - 0.5)"), {0.2, 0.1}, {3, 1});
  EXPECT_TRUE(holds(scene.choice.form, "smooth between 1 lines"));
  ASSERT_EQ(run(*scene.plant, noHand, 0.25), StepStatus::Ok);
  const MassState mass = observed(*scene.plant)[0];
  EXPECT_NEAR(mass.q[0], 0.2 + 0.75, 1e-9) << "equally steep on either side";
  EXPECT_NEAR(mass.q[1], 0.1 + 0.25, 1e-9);
  EXPECT_NEAR(mass.qRate[0], 3, 1e-9);
  EXPECT_NEAR(mass.qRate[1], 1, 1e-9);
  EXPECT_NEAR(mass.r.z, 0.045, 1e-10);
}

// Four planes. Over u = 1/2 what is along r_v stays and u' as well; over v = 0.3 what is along r_u, and v'.
TEST(Surface, TwoCreasesArePassedOneAfterTheOther) {
  const Scene scene = freeScene(onSurface("0.1*u", "0.1*v", "0.1*abs(u - 0.5) + 0.05*abs(v - 0.3)"), {0.2, 0.1}, {3, 1.5});
  const double before = scene.plant->energy({});
  ASSERT_EQ(run(*scene.plant, noHand, 0.15), StepStatus::Ok);
  const double e = 0.02, f = 0.005, g = 0.0125, vRate = 1.5 + 2 * f * 3 / g, uRate = 3 - 2 * f * vRate / e;
  const double first = 0.1, second = first + (0.3 - 0.25) / vRate;
  const MassState mass = observed(*scene.plant)[0];
  EXPECT_NEAR(mass.qRate[0], uRate, 1e-9);
  EXPECT_NEAR(mass.qRate[1], vRate, 1e-9);
  EXPECT_NEAR(mass.q[0], 0.5 + 3 * (second - first) + uRate * (0.15 - second), 1e-9);
  EXPECT_NEAR(mass.q[1], 0.3 + vRate * (0.15 - second), 1e-9);
  EXPECT_NEAR(scene.plant->energy({}) / before, 1, 1e-11);
}

TEST(Surface, TheBranchIsThatOfThePlaceOrOfTheWayFromALine) {
  for (const double rate : {2.0, -2.0}) {
    const Scene scene = freeScene(onSurface("0.1*u", "0.1*v", "0.1*abs(u - 0.5) + 0.05*abs(v)"), {0.5, 0}, {rate, -rate});
    ASSERT_EQ(run(*scene.plant, noHand, 0.1), StepStatus::Ok);
    const MassState mass = observed(*scene.plant)[0];
    EXPECT_NEAR(mass.q[0], 0.5 + 0.1 * rate, 1e-9);
    EXPECT_NEAR(mass.q[1], -0.1 * rate, 1e-9);
    EXPECT_NEAR(mass.r.z, 0.02 + 0.01, 1e-10);
  }
}

// --- RK4's error over a reach

TEST(Rk4Error, IsMeasuredOnlyWhereThereIsAReach) {
  Experiment e = makePoint(1, {600, 5});
  const Scene scene = compileScene(e, {"rk4", 1e-2, 0});
  experiment::Task task;
  task.start = {1}, task.target = {2}, task.duration = 1;
  const auto measured = [&](const experiment::Task& t, double step) { return measureRk4Error(*scene.plant, t, *scene.constraint, step); };
  ASSERT_TRUE(measured(task, 1e-2));
  EXPECT_GT(*measured(task, 1e-2), 0);
  const auto spoilt = [&](auto change) {
    experiment::Task t = task;
    change(t);
    return measured(t, 1e-2).has_value();
  };
  EXPECT_FALSE(spoilt([](auto& t) { t.target = {1}; })) << "start and target are one place";
  EXPECT_FALSE(spoilt([](auto& t) { t.start = {1, 2}; }));
  EXPECT_FALSE(spoilt([](auto& t) { t.target = {}; }));
  EXPECT_FALSE(spoilt([](auto& t) { t.duration = 0; }));
  EXPECT_TRUE(spoilt([](auto& t) { t.duration = 0.001; })) << "one step is enough";
  EXPECT_FALSE(spoilt([](auto& t) { t.target = {INFINITY}; }));
  EXPECT_FALSE(measured(task, 0.99e-5)) << "more than 100,000 steps are not";
  EXPECT_TRUE(measured(task, 1.01e-5));
}

TEST(StepStatus, HasWordsForEachOfItsKinds) {
  EXPECT_EQ(kStepStatusCount, static_cast<int>(StepStatus::PeerLost) + 1);
  std::vector<std::string> words;
  for (int i = 0; i < kStepStatusCount; ++i) words.emplace_back(describe(static_cast<StepStatus>(i)));
  EXPECT_EQ(words, (std::vector<std::string>{"ok", "hand lost", "not finite", "too many sub-steps", "end of the constraint",
                                             "no continuation", "peer lost"}));
}

}  // namespace
}  // namespace reachlab::dynamics
