#include "sim/dynamics/choose_method.h"

#include <gtest/gtest.h>

#include "sim/dynamics/object/stability.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

constexpr double kSceneStep = 0.5;  // [s]

/// One mass of 2 kg whose mode is `reach` rad a step; more of them, each on its own spring, when `count` says so.
ObjectModel oscillating(double reach, int count = 1) {
  const auto n = static_cast<std::size_t>(count);
  ObjectModel model;
  model.kind = count > 1 ? experiment::ObjectKind::Parallel : experiment::ObjectKind::Point;
  model.mass.assign(n, 2);
  model.handStiffness.assign(n, 2 * (reach / kSceneStep) * (reach / kSceneStep));
  model.handDamping.assign(n, 0);
  return model;
}
MethodChoice chosen(const std::string& asked, const ObjectModel& model, SceneFacts facts = {}) {
  facts.step = kSceneStep;
  return chooseMethod(asked, model, facts);
}
std::string refusalOfMethod(const std::string& asked, const ObjectModel& model, const SceneFacts& facts = {}) {
  return refusalOf([&] { (void)chosen(asked, model, facts); });
}

TEST(ChooseMethod, AutoTakesTheMethodThatTheFastestModeBears) {
  for (const char* asked : {"auto", ""}) {
    EXPECT_EQ(chosen(asked, oscillating(0.299)).method, "abm");
    EXPECT_EQ(chosen(asked, oscillating(0.301)).method, "adaptive");
    EXPECT_EQ(chosen(asked, oscillating(99)).method, "adaptive");
    EXPECT_EQ(chosen(asked, oscillating(101)).method, "stiff");
    EXPECT_EQ(chosen(asked, oscillating(101, 24)).method, "stiff");
    EXPECT_EQ(chosen(asked, oscillating(101, 25)).method, "adaptive");
    EXPECT_EQ(chosen(asked, oscillating(1000), {.linear = true}).method, "exact");
  }
}

TEST(ChooseMethod, ElasticEndsAreLeftToSubSteps) {
  const SceneFacts elastic{.linear = true, .elasticEnds = true};
  EXPECT_EQ(chosen("auto", oscillating(0.1), elastic).method, "adaptive");
  EXPECT_EQ(chosen("auto", oscillating(101), elastic).method, "stiff");
  EXPECT_TRUE(holds(chosen("auto", oscillating(0.1), elastic).reason, "the ends are elastic"));
  EXPECT_FALSE(holds(chosen("auto", oscillating(1)).reason, "elastic"));
  EXPECT_TRUE(holds(refusalOfMethod("exact", oscillating(0.1), elastic), "does not know elastic ends; use auto or adaptive"));
}

TEST(ChooseMethod, TheReasonTellsTheNumbersAndWhatFollowsFromThem) {
  const auto reason = [](double reach, const SceneFacts& facts = {}) { return chosen("auto", oscillating(reach), facts).reason; };
  EXPECT_TRUE(holds(reason(0.25), "fastest mode 0.5 1/s, times step 0.25: within 0.3, Adams-Bashforth-Moulton"));
  EXPECT_TRUE(holds(reason(0.25), "by an embedded pair of order 8"));
  EXPECT_TRUE(holds(reason(0.25, {.hardCurve = true}), "sub-steps in a fictitious time, which passes cusps"));
  EXPECT_TRUE(holds(reason(4), "fastest mode 8 1/s, times step 4: sub-steps of an embedded pair of order 8 (one step a tick up to 0.3)"));
  EXPECT_TRUE(holds(reason(200), "times step 200: beyond 100 only an L-stable method is affordable"));
  EXPECT_TRUE(holds(reason(4, {.linear = true}), "the matrix exponential is exact"));
  EXPECT_TRUE(holds(reason(4, {.linear = true}), "(fastest mode 8 1/s, times step 4)"));
  EXPECT_TRUE(chosen("auto", oscillating(200)).warnings.empty());
  EXPECT_TRUE(
      holds(chosen("auto", oscillating(200), {.hardCurve = true}).warnings.at(0), "stiff cannot pass places where |r_phi| is small"));
  EXPECT_EQ(chosen("adaptive", oscillating(4)).reason, "asked for; fastest mode 8 1/s, times step 4");
}

TEST(ChooseMethod, EveryMethodForetellsItsError) {
  EXPECT_EQ(chosen("exact", oscillating(1), {.linear = true}).predictedError, 1e-14);
  EXPECT_EQ(chosen("stiff", oscillating(1)).predictedError, 1e-9);
  EXPECT_EQ(chosen("abm", oscillating(1)).predictedError, 1e-11);
  EXPECT_EQ(chosen("adaptive", oscillating(1)).predictedError, 1e-11);
  const ObjectModel model = oscillating(0.1);
  const SceneFacts facts{.length = 0.3, .duration = 70};
  EXPECT_EQ(chosen("rk4", model, facts).predictedError, predictRk4Error(computeEigenvalues(model), kSceneStep, 0.3, 70));
  EXPECT_GT(chosen("rk4", model, facts).predictedError, 0);
}

// |R(3i)| = |-0.125 - 1.5 i|, R(-3) = 1.375.
TEST(ChooseMethod, AnUnstableRk4IsRefusedWithItsFastestModeItsGrowthAndItsLongestStep) {
  const std::string undamped = refusalOfMethod("rk4", oscillating(3));
  EXPECT_TRUE(holds(undamped, "the fastest mode times the step is 3, its limit 2.828 (an undamped mode)"));
  EXPECT_TRUE(holds(undamped, "multiplies that mode by 1.505"));
  EXPECT_TRUE(holds(undamped, "use method auto, or a step below 0.471 s"));
  ObjectModel damped = oscillating(0);
  damped.viscosity = 12;
  const std::string real = refusalOfMethod("rk4", damped);
  EXPECT_TRUE(holds(real, "times the step is 3, its limit 2.785 (a real mode: light mass, strong damper)"));
  EXPECT_TRUE(holds(real, "multiplies that mode by 1.375"));
  EXPECT_TRUE(holds(real, "a step below 0.464 s"));
  EXPECT_EQ(refusalOfMethod("rk4", oscillating(2.82)), "");
  damped.viscosity = 11.1;
  EXPECT_EQ(refusalOfMethod("rk4", damped), "");
  ObjectModel two = oscillating(3, 3);  // the one that grows most is told, wherever it stands
  two.handStiffness[1] *= 4;
  EXPECT_TRUE(holds(refusalOfMethod("rk4", two), "the fastest mode times the step is 6,"));
}

TEST(ChooseMethod, WhatAMethodCannotDoIsRefusedWithWhatCan) {
  EXPECT_TRUE(holds(refusalOfMethod("exact", oscillating(0.1)), "method exact is for linear scenes"));
  EXPECT_TRUE(
      holds(refusalOfMethod("euler", oscillating(0.1)), "there is no method 'euler'; allowed: auto, rk4, exact, abm, adaptive, stiff"));
  EXPECT_EQ(refusalOfMethod("stiff", oscillating(10, 24)), "");
  EXPECT_TRUE(holds(refusalOfMethod("stiff", oscillating(10, 25)), "for up to 24 masses, and here are 25; use auto, or fewer masses"));
  for (const char* method : {"abm", "adaptive"}) {
    EXPECT_EQ(refusalOfMethod(method, oscillating(449)), "") << method;
    const std::string words = refusalOfMethod(method, oscillating(460));
    EXPECT_TRUE(holds(words, std::string("method ") + method + " would need more than 1000 right-hand sides a tick"));
    EXPECT_TRUE(holds(words, "times step 460, limit 450; use method stiff, or a smaller step"));
    EXPECT_TRUE(holds(refusalOfMethod(method, oscillating(460), {.linear = true}), "use method exact, or"));
    EXPECT_EQ(refusalOfMethod(method, oscillating(460, 24)), words);
    EXPECT_TRUE(holds(refusalOfMethod(method, oscillating(460, 25)), "use method stiff with at most 24 masses, or"));
  }
}

TEST(ChooseMethod, TheFastestModeIsTheLargestOfAll) {
  ObjectModel model = oscillating(2, 3);
  model.handStiffness = {2 * 16, 2 * 100, 2 * 49};
  EXPECT_NEAR(chosen("auto", model).fastestMode, 10, 1e-12);
}

}  // namespace
}  // namespace reachlab::dynamics
