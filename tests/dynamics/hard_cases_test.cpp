#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "base/math/minimum_jerk.h"
#include "sim/dynamics/hand/hand_path.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/held_segment.h"
#include "tests/dynamics/make_experiment.h"
#include "tests/refusal.h"

namespace reachlab::dynamics {
namespace {

experiment::Experiment onEllipse(experiment::Experiment e) { return onCurve(std::move(e), "0.1*cos(phi)", "0.06*sin(phi)", "0"); }

TEST(HardCases, AHandThatJumpsTenCentimetresLeavesAFiniteState) {
  for (const bool curved : {false, true}) {
    const experiment::Experiment line = makeChain(5, 0.6, 600);
    const Scene scene = compileScene(curved ? onEllipse(line) : line);
    scene.plant->placeAtRest(std::array{0.5});
    HandPath path;
    for (int i = 0; i < 200; ++i) {
      if (!path.push({{i < 100 ? 0.0 : 0.1, 0, 0}, {}, true})) scene.plant->restart();
      ASSERT_EQ(scene.plant->step(path.segment(), 1e-3), StepStatus::Ok);
    }
    for (const MassState& mass : observed(*scene.plant)) EXPECT_TRUE(isFinite(mass.r) && norm(mass.r) < 1);
  }
}

TEST(HardCases, ANumberThatIsNoneEndsTheStepAndNotTheState) {
  for (const char* method : {"auto", "rk4", "abm", "adaptive", "stiff"})
    for (const bool curved : {false, true}) {
      const experiment::Experiment line = makeChain(2, 0.6, 600);
      const Scene scene = compileScene(curved ? onEllipse(line) : line, {method, 1e-3, 0});
      scene.plant->placeAtRest(std::array{0.5});
      HandSegment broken = heldSegment({std::numeric_limits<double>::quiet_NaN(), 0, 0});
      const auto before = observed(*scene.plant);
      EXPECT_EQ(scene.plant->step(broken, 1e-3), StepStatus::NotFinite) << method << curved;
      EXPECT_EQ(observed(*scene.plant)[1].r, before[1].r) << method << curved;
      EXPECT_EQ(scene.plant->step(heldSegment({}), 1e-3), StepStatus::Ok) << method << curved;
    }
}

TEST(HardCases, AMassRatioOfAMillionKeepsItsEnergy) {
  const Scene scene = compileScene(makeExperiment(experiment::ObjectKind::Chain, {1e-3, 1e3}, {600}));
  scene.plant->place(std::array{0.0}, std::array{5.0});
  const HandSample hand{{-0.1, 0, 0}, {}, true};
  const double before = scene.plant->energy(hand);
  ASSERT_EQ(run(*scene.plant, hand, 10), StepStatus::Ok);
  EXPECT_NEAR(scene.plant->energy(hand) / before, 1, 1e-10) << "ten thousand roundings of 1000 kg beside 1 g";
}

TEST(HardCases, FiveHundredMassesMoveOnACurve) {
  const Scene scene = compileScene(onEllipse(makeChain(500, 0.006, 600)));
  scene.plant->place(std::array{0.5}, std::array{1.0});
  const HandSample hand{{0.1 * std::cos(0.5), 0.06 * std::sin(0.5), 0}, {}, true};
  const double before = scene.plant->energy(hand);
  ASSERT_EQ(run(*scene.plant, hand, 0.1), StepStatus::Ok);
  EXPECT_NEAR(scene.plant->energy(hand) / before, 1, 1e-9);
}

TEST(HardCases, WhatHasNoMotionIsRefusedInWords) {
  EXPECT_THROW((void)compileScene(makeChain(2, 0, 600)), RefusedError);
  EXPECT_THROW((void)compileScene(makeChain(2, std::numeric_limits<double>::quiet_NaN(), 600)), RefusedError);
  experiment::Experiment e = onCurve(makePoint(), "0", "0", "0.1*phi");
  EXPECT_THROW((void)compileScene(e, {"exact", 0, 0}), RefusedError) << "a step of nothing";
  e = makeChain(2, 0.6, 600);
  e.constraint.shape["length_m"] = 0;
  EXPECT_THROW((void)compileScene(e), Error) << "a line without length";
  experiment::Experiment wrong = makeExperiment(experiment::ObjectKind::Chain, {1, 1}, {});
  EXPECT_THROW((void)compileScene(wrong), RefusedError) << "a spring is missing";
}

TEST(HardCases, ALineThatHasNoPlaceAtTheStartIsRefused) {
  const experiment::Experiment e = from(onCurve(makePoint(), "1e10*phi", "0", "0"), {1e300}, {2e300});
  EXPECT_TRUE(holds(refusalOfScene(e), "has no finite value there"));
}

// c + phi is rounded by 2^-53 of it; allowed are 1e-9 m, and 1e-13 of how far away the place is.
TEST(HardCases, RoundingsInsideAFormulaMayMoveAMassByTenToTheMinus13OfItsPlace) {
  for (const double away : {0.0, 1e6})
    for (const double share : {0.9, 1.2}) {
      experiment::Experiment e = from(onCurve(makePoint(), "away + phi/10", "(c + phi) - c", "0"), {0}, {1});
      e.constraint.shape = {{"away", away}, {"c", share * (1e-9 + 1e-13 * away) * 0x1p53}};
      EXPECT_EQ(refusalOfScene(e).find("loses its digits") != std::string::npos, share > 1)
          << away << " " << share << " " << refusalOfScene(e);
    }
}

// Looked at about the start, three to either side: noise that is not everywhere, and a formula that ends within, are judged by most places.
TEST(HardCases, WhetherAFormulaLosesItsDigitsIsJudgedAllAboutTheStart) {
  const auto refused = [](const std::string& y) {
    return refusalOfScene(from(onCurve(makePoint(), "phi/10", y, "0"), {0}, {0.5})).find("loses its digits") != std::string::npos;
  };
  EXPECT_TRUE(refused("(1e9 + phi) - 1e9"));
  EXPECT_TRUE(refused("(1e9 + phi) - 1e9 + sqrt(phi + 2.9)"));
  EXPECT_FALSE(refused("(1e9*exp(-100*(phi + 3)^2) + phi) - 1e9*exp(-100*(phi + 3)^2)"));
}

TEST(HardCases, SpringsOfNoStiffnessLeaveMassesAlone) {
  const Scene scene = compileScene(makeExperiment(experiment::ObjectKind::Chain, {1, 1}, {0}));
  scene.plant->place(std::array{0.0}, std::array{1.0});
  const double speed = observed(*scene.plant)[1].v.x;
  ASSERT_EQ(run(*scene.plant, reachAt, 1), StepStatus::Ok);
  EXPECT_NEAR(observed(*scene.plant)[1].r.x, -0.1 + speed, 1e-13);
}

/// Along the ellipse of 0.1 m by 0.06 m, from phi = 0.3.
HandSample alongEllipse(double t) {
  const double s = 0.3 + heldMinimumJerk(t / 1.35).value, rate = heldMinimumJerk(t / 1.35).rate / 1.35;
  return {{0.1 * std::cos(s), 0.06 * std::sin(s), 0}, {-0.1 * std::sin(s) * rate, 0.06 * std::cos(s) * rate, 0}, true};
}

// 4b/m = 20000/s: RK4's limit at 1 ms is 2785. On a curve the stiff method takes it.
TEST(HardCases, DampersThatBreakRk4AreTakenByAuto) {
  experiment::Experiment e = makeChain(3, 0.01, 2e4, {600, 5});
  e.object.damping.assign(2, 5000);
  e = onEllipse(e);
  EXPECT_THROW((void)compileScene(e, {"rk4", 1e-3, 0}), RefusedError);
  const Scene scene = compileScene(e), fine = compileScene(e, {"adaptive", 1e-4, 0});
  EXPECT_EQ(scene.choice.method, "stiff");
  for (const Scene* s : {&scene, &fine}) s->plant->placeAtRest(std::array{0.3});
  ASSERT_EQ(run(*scene.plant, alongEllipse, 0.3), StepStatus::Ok);
  ASSERT_EQ(run(*fine.plant, alongEllipse, 0.3, 1e-4), StepStatus::Ok);
  const auto a = observed(*scene.plant), b = observed(*fine.plant);
  for (int i = 0; i < 3; ++i) EXPECT_LT(norm(a[i].r - b[i].r), 1e-9) << "Radau against the explicit pair";
}

// Sixteen thousand turns on, phi itself is rounded by 1e-11: the same place, followed by the same method.
TEST(HardCases, TheStiffMethodFollowsACurveManyTurnsOnAsWell) {
  const experiment::Experiment e = onEllipse(makeChain(2, 0.1, 600));
  const auto after = [&](double turns) {
    const Scene scene = compileScene(e, {"stiff", 1e-3, 0});
    scene.plant->placeAtRest(std::array{0.3 + turns * 2 * std::numbers::pi});
    EXPECT_EQ(run(*scene.plant, alongEllipse, 0.2), StepStatus::Ok) << turns;
    return observed(*scene.plant);
  };
  const auto here = after(0), far = after(16000);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(norm(here[i].r - far[i].r), 1e-8) << i;
}

// The L-stable method's systems are dense: a longer chain is taken by the explicit pair as far as its cap reaches, then refused.
TEST(HardCases, LongStiffChainsOnACurveAreTakenOrRefusedInWords) {
  const auto damped = [](double b) {
    experiment::Experiment e = makeChain(40, 0.01, 600);
    e.object.damping.assign(39, b);
    return onEllipse(e);
  };
  EXPECT_EQ(compileScene(damped(500)).choice.method, "adaptive") << "4 b/m dt = 200";
  EXPECT_TRUE(holds(refusalOfScene(damped(5000)), "at most 24 masses"));
}

}  // namespace
}  // namespace reachlab::dynamics
