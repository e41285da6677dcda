#include <gtest/gtest.h>

#include <limits>

#include "sim/dynamics/object/stability.h"
#include "sim/dynamics/shared_plant.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

using experiment::Experiment;
using experiment::ObjectKind;

Experiment bead() { return makePoint(1, {600, 5}); }
Experiment ellipse(double a, double b) { return onCurve(bead(), std::to_string(a) + "*cos(phi)", std::to_string(b) + "*sin(phi)", "0"); }

TEST(Scene, AStepIsAboveNothingAndFinite) {
  for (const double step : {0.0, -1e-3, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_TRUE(holds(refusalOfScene(bead(), {"", step, 0}), "the step must be positive, not ")) << step;
  EXPECT_EQ(refusalOfScene(bead(), {"", 1e-9, 0}), "");
  EXPECT_EQ(SceneOptions{}.step, 0.001);
  EXPECT_EQ(SceneOptions{}.tolerance, 0);
}

TEST(Scene, AStartHasAsManyNumbersAsTheConstraint) {
  const Experiment line = bead(), open = free(bead()), sphere = onSurface("0.1*cos(u)*cos(v)", "0.1*sin(u)*cos(v)", "0.1*sin(v)");
  EXPECT_EQ(refusalOfScene(from(line, {1}, {2})), "");
  EXPECT_EQ(refusalOfScene(from(sphere, {1, 0.2}, {2, 0.1})), "");
  EXPECT_EQ(refusalOfScene(from(open, {1, 2, 3}, {2, 1, 0})), "");
  EXPECT_TRUE(holds(refusalOfScene(from(line, {1, 2}, {2})), "the start has 2 numbers where the constraint has 1"));
  EXPECT_TRUE(holds(refusalOfScene(from(sphere, {1}, {2, 0.1})), "the start has 1 numbers where the constraint has 2"));
  EXPECT_TRUE(holds(refusalOfScene(from(open, {1, 2}, {2, 1, 0})), "the start has 2 numbers where the constraint has 3"));
  EXPECT_EQ(refusalOfScene(from(open, {-1, 2, std::numeric_limits<double>::quiet_NaN()}, {2, 1, 0})), "the start is not finite");
}

TEST(Scene, AStartLiesWithinTheDomainOrOnItsEnds) {
  const Experiment curve = onDefinition(bead(), "curve", R"(["0.1*phi", "0.1*phi^2", "0"])", "[-1, 2]", "stop");
  for (const double start : {-1.0, 0.3, 2.0}) EXPECT_EQ(refusalOfScene(from(curve, {start}, {1})), "") << start;
  for (const double start : {-1.01, 2.01})
    EXPECT_TRUE(holds(refusalOfScene(from(curve, {start}, {1})), "lies outside the constraint's domain, -1 to 2")) << start;
  const Experiment patch = onDefinition(bead(), "surface", R"(["0.1*u", "0.1*v", "0.05*u*v^2"])", "[[-1, 1], [-2, 2]]", "stop");
  EXPECT_EQ(refusalOfScene(from(patch, {1, -2}, {0, 0})), "");
  EXPECT_TRUE(holds(refusalOfScene(from(patch, {0, 2.1}, {0, 0})), "the start 2.1 lies outside the constraint's domain, -2 to 2"));
  EXPECT_TRUE(holds(refusalOfScene(from(patch, {1.1, 0}, {0, 0})), "the start 1.1 lies outside"));
  EXPECT_EQ(refusalOfScene(from(ellipse(0.1, 0.06), {20}, {21})), "") << "a period has no ends";
}

TEST(Scene, ObjectsAreRefusedWhereTheyCannotMove) {
  Experiment body = makeExperiment(ObjectKind::Body, {2}, {}, {600, 0});
  body.object.inertia = {{{0.01, 0, 0}, {0, 0.02, 0}, {0, 0, 0.025}}};
  EXPECT_EQ(refusalOfScene(onCurve(body, "0.1*cos(phi)", "0.1*sin(phi)", "0")),
            "a body moves in free space only; use point, chain or parallel on a curve");
  Experiment chain = onSurface("0.1*cos(u)*cos(v)", "0.1*sin(u)*cos(v)", "0.1*sin(v)");
  chain.object = makeChain(2, 0.5, 100).object;
  EXPECT_EQ(refusalOfScene(chain), "on a surface only a point moves; use a curve, or one mass");
  body.constraint.surface = chain.constraint.surface;
  EXPECT_EQ(refusalOfScene(body), "on a surface only a point moves; use a curve, or one mass");
  EXPECT_TRUE(holds(refusalOfScene(from(onSurface("u/10", "v/10", "sqrt(u)"), {-0.5, 0}, {1, 1})),
                    "the surface has no value at the start u = -0.5, v = 0"));
}

TEST(Scene, AnInertiaIsSymmetricAndPositiveDefinite) {
  const auto with = [](const std::array<std::array<double, 3>, 3>& inertia) { return refusalOfScene(makeBody(inertia)); };
  EXPECT_EQ(with({{{2, 0.3, 0.1}, {0.3, 3, 0.2}, {0.1, 0.2, 4}}}), "");
  EXPECT_EQ(with({{{2, 0, 0}, {0, 3, 0}, {0, 0, 2e-12}}}), "") << "thin, but a body";
  for (const auto& wrong : {std::array<std::array<double, 3>, 3>{{{2, 0.3, 0.1}, {0.31, 3, 0.2}, {0.1, 0.2, 4}}},
                            {{{2, 0.3, 0.1}, {0.3, 3, 0.2}, {0.11, 0.2, 4}}},
                            {{{2, 0.3, 0.1}, {0.3, 3, 0.2}, {0.1, 0.21, 4}}},
                            {{{-2, 0, 0}, {0, -3, 0}, {0, 0, 4}}},
                            {{{2, 0, 0}, {0, -3, 0}, {0, 0, -4}}},
                            {{{0, 0, 0}, {0, 3, 0}, {0, 0, 4}}},
                            {{{2, 3, 0}, {3, 2, 0}, {0, 0, 4}}},
                            {{{2, 0, 0}, {0, 2, 3}, {0, 3, 2}}},
                            {{{2, 0, 0}, {0, 3, 0}, {0, 0, 0}}}})
    EXPECT_TRUE(holds(with(wrong), "inertia_kg_m2 must be symmetric and positive definite"));
}

TEST(Scene, ItsFormTellsWhatIsComputed) {
  const auto form = [](const Experiment& e) { return compileScene(e).choice.form; };
  EXPECT_EQ(form(makeBody({{{0.01, 0, 0}, {0, 0.02, 0}, {0, 0, 0.025}}})), "rigid body, 13 states");
  EXPECT_EQ(form(ellipse(0.1, 0.06)), "curve in phi, 2 states");
  EXPECT_EQ(form(onCurve(makeChain(3, 0.5, 100), "0.1*cos(phi)", "0.06*sin(phi)", "0")), "curve in phi, 6 states");
  EXPECT_EQ(form(onSurface("0.1*cos(u)*cos(v)", "0.08*sin(u)*cos(v)", "0.1*sin(v)")),
            "surface of second degree in world coordinates, 6 states");
  EXPECT_EQ(form(onSurface("u/10", "v/10", "0.05*sin(u)*v")), "surface in u and v, 4 states");
  EXPECT_EQ(form(onSurface("u/10", "v/10", "0.05*abs(u - 2) + 0.01*v^3")), "surface in u and v, 4 states, smooth between 1 lines");
  const std::string pieces = form(onCurve(makeChain(2, 0.5, 100), "phi/10", "0.05*abs(phi - 2)", "0"));
  EXPECT_TRUE(holds(pieces, "curve by 2 smooth pieces (examined from phi = "));
  EXPECT_TRUE(holds(pieces, "speed along it, 4 states"));
}

TEST(Scene, AStraightLineWithElasticEndsIsLeftToSubSteps) {
  const auto chosen = [](const char* domain, const char* atEnd) {
    return compileScene(onDefinition(bead(), "curve", R"(["0.1*phi", "0.2*phi", "0.3"])", domain, atEnd)).choice;
  };
  EXPECT_EQ(chosen("[-1, 2]", "bounce").method, "adaptive");
  EXPECT_TRUE(holds(chosen("[-1, 2]", "bounce").reason, "the ends are elastic"));
  EXPECT_EQ(chosen("[-1, 2]", "bounce").form, "line, 2 states");
  EXPECT_EQ(chosen("[-1, 2]", "stop").method, "exact");
  EXPECT_EQ(compileScene(bead()).choice.method, "exact");
  Experiment still = onCurve(bead(), "0.1", "0.2", "0.3");
  EXPECT_NE(refusalOfScene(still), "");
}

// |r_phi| of an ellipse goes from b to a.
TEST(Scene, ACurveIsHardWhereItsSpeedFallsBelowAFifth) {
  EXPECT_EQ(compileScene(ellipse(0.1, 0.0201)).choice.form, "curve in phi, 2 states");
  EXPECT_EQ(compileScene(ellipse(0.1, 0.0199)).choice.form, "curve, speed along it (|r_phi| falls to 0.2 of its largest), 2 states");
  EXPECT_EQ(compileScene(ellipse(0.1, 0.0123)).choice.form, "curve, speed along it (|r_phi| falls to 0.12 of its largest), 2 states");
  EXPECT_TRUE(compileScene(ellipse(0.1, 0.0201), {"rk4", 1e-4, 0}).choice.warnings.empty());
  const auto warnings = compileScene(ellipse(0.1, 0.0199), {"rk4", 1e-4, 0}).choice.warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_TRUE(holds(warnings[0], "|r_phi| is small"));
  EXPECT_TRUE(holds(compileScene(ellipse(0.1, 0.0123)).choice.reason, "sub-steps in a fictitious time, which passes cusps"));
}

// |r_phi| = |R - 4 d e^(3 i phi)|, from R - 4 d to R + 4 d: a dip that lies between the looks is followed to its bottom.
TEST(Scene, ANarrowDipOfTheSpeedIsFoundBetweenTheLooks) {
  for (const char* shift : {"0", "0.0011", "0.0029"}) {
    const std::string phi = std::string("(phi+") + shift + ")";
    const Experiment e =
        onCurve(bead(), "0.08*cos" + phi + "-0.019998*cos(4*" + phi + ")", "0.08*sin" + phi + "-0.019998*sin(4*" + phi + ")", "0");
    EXPECT_EQ(compileScene(from(e, {1}, {2})).choice.form, "curve, speed along it (|r_phi| falls to 5e-05 of its largest), 2 states")
        << shift;
  }
}

// From e^-3 to e^3 of what it is in the middle: more than eight times that is steep and not what is usual.
TEST(Scene, TheLargestSpeedCountsUpToEightTimesTheUsualOne) {
  const auto form = [](const char* along, double start) {
    const Experiment e = onDefinition(bead(), "curve", std::string("[\"0.01*") + along + "\", \"1e-6*phi^2\", \"0\"]", "[-3, 3]", "stop");
    return compileScene(from(e, {start}, {1})).choice.form;
  };
  EXPECT_EQ(form("exp(phi)", 0), "curve, speed along it (|r_phi| falls to 0.0062 of its largest), 2 states") << "e^-3/8";
  EXPECT_EQ(form("exp(phi/2)", 0), "curve, speed along it (|r_phi| falls to 0.05 of its largest), 2 states") << "e^-1.5/e^1.5";
}

// 2^-53 phi 0.1 m are 1e-13 m, and 1e-15 of |r|, at phi = 9016; of a circle whole turns are taken off.
TEST(Scene, ASpiralsStartIsNotSoFarThatItsPhiIsRounded) {
  const auto starting = [](double phi, const char* z) {
    return refusalOfScene(from(onCurve(bead(), "0.1*cos(phi)", "0.1*sin(phi)", z), {phi}, {phi + 1}));
  };
  EXPECT_EQ(starting(9010, "phi/1e7"), "");
  EXPECT_TRUE(holds(starting(9025, "phi/1e7"), "is so far from 0 that a rounding of phi moves the mass by 1e-13 m"));
  EXPECT_TRUE(holds(starting(-9025, "phi/1e7"), "so far from 0"));
  EXPECT_EQ(starting(1e6, "0"), "");
}

TEST(Scene, Rk4IsWarnedOfWhatItErrsByAboveAMicrometre) {
  Experiment chain = from(makeChain(3, 0.5, 300), {0}, {2 * std::numbers::pi});
  int warned = 0, silent = 0;
  for (const double step : {1e-3, 5e-3, 1e-2, 1.2e-2, 1.4e-2, 1.6e-2, 2e-2, 3e-2}) {
    const MethodChoice choice = compileScene(chain, {"rk4", step, 0}).choice;
    const bool much = choice.predictedError > 1e-6;
    ++(much ? warned : silent);
    ASSERT_EQ(choice.warnings.size(), much ? 1u : 0u) << step << ": " << choice.predictedError;
    if (much) {
      EXPECT_TRUE(holds(choice.warnings[0], "rk4 is stable but not accurate here: fastest mode times step "));
    }
  }
  EXPECT_GT(warned, 1);
  EXPECT_GT(silent, 1);
  chain.task.reset();
  EXPECT_NEAR(compileScene(chain, {"rk4", 1e-2, 0}).choice.predictedError,
              predictRk4Error(computeEigenvalues(makeObjectModel(chain)), 1e-2, 0.2, 1.35), 1e-18)
      << "without a reach, by the modes alone";
}

// --- several hands

Experiment twoHands(Experiment e) {
  e.hands = {{1, {600}, {5}, {}}, {1, {600}, {5}, {}}};
  return e;
}

TEST(Scene, SeveralHandsAreComputedByRk4Alone) {
  const Experiment e = twoHands(ellipse(0.1, 0.06));
  for (const char* method : {"", "auto", "rk4"}) {
    const Scene scene = compileScene(e, {method, 1e-3, 0});
    EXPECT_EQ(scene.choice.method, "rk4");
    EXPECT_EQ(scene.choice.form, "2 hands, 2 states");
    EXPECT_TRUE(scene.choice.reason.starts_with("several hands hold the object: rk4, one step a tick; ")) << scene.choice.reason;
    EXPECT_EQ(static_cast<Plant*>(scene.shared), scene.plant.get());
  }
  EXPECT_TRUE(holds(refusalOfScene(e, {"abm", 1e-3, 0}), "method abm is for one hand; several hands are computed by rk4: use auto or rk4"));
  EXPECT_EQ(compileScene(ellipse(0.1, 0.06)).shared, nullptr);
}

TEST(Scene, SeveralHandsNeedASmoothCurveThatMovesOnEvenly) {
  EXPECT_TRUE(holds(refusalOfScene(twoHands(ellipse(0.1, 0.00099))), "|r_phi| falls to 0.0099 of its largest (a cusp, or nearly one)"));
  EXPECT_FALSE(holds(refusalOfScene(twoHands(ellipse(0.1, 0.00101))), "falls to"));
  EXPECT_TRUE(holds(refusalOfScene(twoHands(onCurve(bead(), "phi/10", "0.05*abs(phi - 2)", "0"))),
                    "several hands need a curve that is smooth throughout"));
  const auto ended = [](const char* atEnd) {
    return refusalOfScene(twoHands(onDefinition(bead(), "curve", R"(["0.1*phi", "0.1*phi^2", "0"])", "[-1, 2]", atEnd)));
  };
  EXPECT_TRUE(holds(ended("bounce"), "several hands need a curve without elastic ends"));
  EXPECT_EQ(ended("stop"), "");
  EXPECT_TRUE(holds(refusalOfScene(twoHands(onSurface("u/10", "v/10", "0.05*sin(u)*v"))), "and in free space, not on surfaces"));
}

TEST(Scene, SeveralHandsAreWarnedAboveAMicrometreAndRefusedAboveATenthOfAMillimetre) {
  const Experiment e = from(twoHands(ellipse(0.1, 0.06)), {0.2}, {2});
  int silent = 0, warned = 0, without = 0;
  for (double step = 1e-3; step < 0.08; step *= 1.25) {
    const std::string words = refusalOfScene(e, {"", step, 0});
    if (!words.empty()) {
      if (holds(words, "unstable")) break;
      ++without;
      EXPECT_TRUE(holds(words, "which errs by "));
      EXPECT_TRUE(holds(words, "use one hand, or a softer object or coupling"));
      EXPECT_GT(std::stod(words.substr(words.find("errs by ") + 8)), 0.99e-4);
      continue;
    }
    EXPECT_EQ(without, 0) << step;
    const MethodChoice choice = compileScene(e, {"", step, 0}).choice;
    EXPECT_LE(choice.predictedError, 1e-4);
    ++(choice.predictedError > 1e-6 ? warned : silent);
    ASSERT_EQ(choice.warnings.size(), choice.predictedError > 1e-6 ? 1u : 0u) << step << ": " << choice.predictedError;
    if (!choice.warnings.empty()) {
      EXPECT_TRUE(holds(choice.warnings[0], "several hands are computed by rk4, one step a tick: predicted error "));
    }
  }
  EXPECT_GT(silent, 1);
  EXPECT_GT(warned, 1);
  EXPECT_GT(without, 0);
}

}  // namespace
}  // namespace reachlab::dynamics
