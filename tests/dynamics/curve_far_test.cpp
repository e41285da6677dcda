// Curves where phi grows large, and those whose formula is smooth by pieces.
#include <gtest/gtest.h>

#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"
#include "tests/dynamics/held_segment.h"

namespace reachlab::dynamics {
namespace {

using experiment::Experiment;
using experiment::ObjectKind;

// Whole turns are taken off phi where it has become large, and added again for who asks.
TEST(FarAlong, OnACircleManyTurnsOnTheDigitsOfThePlaceAreKept) {
  for (const double from : {500.0, 40000.0, -40000.0})
    for (const double rate : {900.0, -900.0}) {
      const Scene scene = freeScene(onCurve(makePoint(), "0.1*cos(phi)", "0.1*sin(phi)", "0"), {from}, {rate});
      EXPECT_NEAR(observed(*scene.plant)[0].q[0], from, 1e-11);
      ASSERT_EQ(run(*scene.plant, noHand, 2), StepStatus::Ok);
      const MassState mass = observed(*scene.plant)[0];
      EXPECT_NEAR(mass.q[0], from + 2 * rate, 2e-9) << "2000 ticks of its tolerance";
      EXPECT_NEAR(mass.qRate[0], rate, 1e-9);
      EXPECT_LT(norm(mass.r - 0.1 * Vec3{std::cos(mass.q[0]), std::sin(mass.q[0]), 0}), 1e-12);
    }
}

TEST(FarAlong, EveryMassOfAChainHasTurnsOfItsOwn) {
  Experiment e = onCurve(makeChain(2, 0.5, 0), "0.1*cos(phi)", "0.1*sin(phi)", "0");
  const Scene scene = freeScene(e, {3000}, {0});
  scene.plant->setExtraForce({0.5 * std::cos(3000.0), 0.5 * std::sin(3000.0), 0});  // along r: it does not start mass 1 by itself
  const auto begin = observed(*scene.plant);
  EXPECT_NEAR(begin[1].q[0], 3000, 1e-12);
  scene.plant->setExtraForce({-400 * std::sin(3000.0), 400 * std::cos(3000.0), 0});
  ASSERT_EQ(run(*scene.plant, noHand, 0.5), StepStatus::Ok);
  const auto after = observed(*scene.plant);
  EXPECT_NEAR(after[1].q[0], 3000, 1e-12) << "nothing pulls the second";
  EXPECT_GT(std::abs(after[0].q[0] - 3000), 0.01);
  for (const MassState& mass : after) EXPECT_LT(norm(mass.r - 0.1 * Vec3{std::cos(mass.q[0]), std::sin(mass.q[0]), 0}), 1e-12);
}

// On a helix nothing comes round again: it is told where a rounding of phi would move the mass, by 1e-13 m at phi = 9016.
TEST(FarAlong, OnAHelixTheMotionEndsWhereARoundingOfPhiShows) {
  for (const double side : {1.0, -1.0}) {
    const Scene scene = freeScene(onCurve(makePoint(), "0.1*cos(phi)", "0.1*sin(phi)", "phi/1e7"), {8800 * side}, {1000 * side});
    EXPECT_EQ(run(*scene.plant, noHand, 0.19), StepStatus::Ok);
    EXPECT_EQ(run(*scene.plant, noHand, 0.2), StepStatus::NoContinuation);
    EXPECT_EQ(scene.plant->lastStepFraction(), 0);
    const double phi = std::abs(observed(*scene.plant)[0].q[0]);
    EXPECT_GT(phi, 9016 - 1);
    EXPECT_LT(phi, 9016 + 65) << "it is looked at every 64 ticks";
    EXPECT_TRUE(holds(scene.plant->stopReason(), "mass 1 at phi = "));
    EXPECT_TRUE(holds(scene.plant->stopReason(), "so far from 0 that a rounding of phi moves it by 1e-13 m"));
  }
}

// Half a circle by its tangent: its end is where phi is infinite.
TEST(FarAlong, ACurveThatEndsOnlyInInfinityIsToldSo) {
  const Scene scene = freeScene(onCurve(makePoint(), "0.1*phi/sqrt(1+phi^2)", "0.1/sqrt(1+phi^2)", "0"), {10}, {2});  // at 2 mm/s
  const StepStatus status = run(*scene.plant, noHand, 8);
  EXPECT_TRUE(status == StepStatus::Capped || status == StepStatus::NotFinite)
      << describe(status) << " at " << observed(*scene.plant)[0].q[0];
  EXPECT_TRUE(holds(scene.plant->stopReason(), "mass 1 at phi = "));
  EXPECT_TRUE(holds(scene.plant->stopReason(), "the curve comes to its end only as phi grows without bound"));
  EXPECT_LT(norm(observed(*scene.plant)[0].r - Vec3{0.1, 0, 0}), 1e-3);
}

// --- by pieces

/// A valley of two straight sides, under gravity.
Experiment valley(double friction) {
  Experiment e = onCurve(makePoint(2), "phi/10", "0.1*abs(phi)", "0");
  e.object.gravity = {0, -9.81, 0};
  e.object.viscosity = friction;
  return e;
}

TEST(Corners, InAValleyAMassSwingsWithItsEnergy) {
  const Scene scene = freeScene(valley(0), {1}, {0});
  const double before = scene.plant->energy({});
  // Down a slope of 45 degrees of 0.1 m by g/2 sin(45): t = sqrt(2 s/a), a fourth of the whole.
  const double quarter = std::sqrt(2 * 0.1 * std::sqrt(2.0) / (9.81 / std::sqrt(2.0)));
  ASSERT_EQ(run(*scene.plant, noHand, 8 * quarter, quarter / 200), StepStatus::Ok);
  EXPECT_NEAR(scene.plant->energy({}) / before, 1, 1e-9);
  EXPECT_NEAR(observed(*scene.plant)[0].q[0], 1, 1e-6) << "twice to and fro";
}

// From half a micrometre up a side, over the corner and back within a tick: no step ends beyond it.
TEST(Corners, SwingsOfLessThanATickKeepTheirEnergyAsWell) {
  for (const double height : {2e-7, 5e-6}) {
    Experiment grooved = makePoint(2);
    grooved.constraint.surface = {"0.1*u", "0.1*v", "0.1*abs(u)"};
    grooved.object.gravity = {0, 0, -9.81};
    const Scene curve = freeScene(valley(0), {height}, {0}), groove = freeScene(grooved, {height, 0.2}, {0, 0.5});
    for (const Scene* scene : {&curve, &groove}) {
      const double at = observed(*scene->plant)[0].r.y, before = scene->plant->energy({});
      double low = height, high = -height;
      for (int tick = 0; tick < 60; ++tick) {
        const StepStatus status = scene->plant->step({}, 1e-3);
        ASSERT_EQ(status, StepStatus::Ok) << tick << " " << at << scene->plant->stopReason();
        EXPECT_NEAR(scene->plant->energy({}), before, 1e-6 * 2 * 9.81 * 0.1 * height + (scene == &groove ? 1e-12 : 0)) << tick;
        const double q = observed(*scene->plant)[0].q[0];
        low = std::min(low, q), high = std::max(high, q);
      }
      EXPECT_LT(low, -0.1 * height) << "it is on both sides";
      EXPECT_GT(low, -1.01 * height);
      EXPECT_LT(high, 1.01 * height);
    }
  }
}

TEST(Corners, InAValleyAMassComesToRestAndIsPulledOutByMoreThanItsWeight) {
  for (const double side : {1.0, -1.0}) {
    const Scene scene = freeScene(valley(30), {0.5 * side}, {0});
    ASSERT_EQ(run(*scene.plant, noHand, 3), StepStatus::Ok);
    EXPECT_EQ(observed(*scene.plant)[0].q[0], 0) << "in the corner itself";
    EXPECT_EQ(observed(*scene.plant)[0].v, Vec3{});
    const double weight = 2 * 9.81;  // at 45 degrees as much sideways holds it on a slope
    for (const double pull : {-1.0, 1.0}) {
      scene.plant->setExtraForce({0.99 * weight * pull, 0, 0});
      ASSERT_EQ(run(*scene.plant, noHand, 0.2), StepStatus::Ok);
      EXPECT_EQ(observed(*scene.plant)[0].q[0], 0);
    }
    for (const double pull : {-1.0, 1.0}) {
      scene.plant->placeAtRest(std::array{0.0});
      scene.plant->setExtraForce({1.01 * weight * pull, 0, 0});
      ASSERT_EQ(run(*scene.plant, noHand, 0.2), StepStatus::Ok);
      // Along the slope 0.01 weight/sqrt(2) against 30 N s/m: near its final speed.
      EXPECT_GT(observed(*scene.plant)[0].q[0] * pull, 1e-3);
      EXPECT_NEAR(observed(*scene.plant)[0].v.x, pull * 0.01 * weight / 2 / 30, 0.1 * 0.01 * weight / 2 / 30);
    }
  }
}

TEST(Corners, OnARidgeNothingTellsWhichWayAMassGoes) {
  Experiment e = valley(0);
  e.object.gravity.y = 9.81;
  const Scene scene = freeScene(e, {0}, {0});
  EXPECT_EQ(run(*scene.plant, noHand, 0.1), StepStatus::NoContinuation);
  EXPECT_EQ(scene.plant->lastStepFraction(), 0);
  EXPECT_TRUE(holds(scene.plant->stopReason(), "a kink that pulls it to both sides: which way it would leave is not determined"));
  scene.plant->setExtraForce({2 * 9.81 * 1.01, 0, 0});
  EXPECT_EQ(run(*scene.plant, noHand, 0.05), StepStatus::Ok) << "now one side pulls alone";
  EXPECT_GT(observed(*scene.plant)[0].q[0], 0);
}

Experiment betweenEnds(Experiment e, const std::string& atEnd, const std::string& y = "0.05*abs(phi - 1)") {
  return onDefinition(std::move(e), "curve", R"(["0.1*phi", ")" + y + R"(", "0"])", "[-1, 2]", atEnd);
}

TEST(Corners, AnEndIsToldByItsMassAndPlace) {
  const auto stopped = [](const Experiment& e, double q, double rate) {
    const Scene scene = freeScene(e, {q}, {rate});
    EXPECT_EQ(run(*scene.plant, noHand, 1), StepStatus::AtEnd);
    return scene.plant->stopReason();
  };
  Experiment jump = onCurve(makePoint(), "phi/10", "0.02*sign(phi - 0.5) + 0.05*abs(phi)", "0");
  EXPECT_TRUE(holds(stopped(jump, 0.2, 1), "mass 1 at phi = 0.5 met a place that is never crossed: jump"));
  EXPECT_TRUE(holds(stopped(jump, 0.8, -1), "mass 1 at phi = 0.5 met a place that is never crossed: jump"));
  const Experiment e = betweenEnds(makePoint(), "stop");
  EXPECT_EQ(stopped(e, 0, 3), "mass 1 at phi = 2 reached the end of the constraint's domain");
  EXPECT_EQ(stopped(e, 0, -3), "mass 1 at phi = -1 reached the end of the constraint's domain");
}

TEST(Corners, ElasticEndsOfACurveWithAKinkThrowMassesBack) {
  const Experiment e = betweenEnds(makePoint(), "bounce");
  for (const double rate : {4.7, -4.7}) {
    const Scene scene = freeScene(e, {0}, {rate});
    for (int tick = 1; tick <= 2000; ++tick) {
      ASSERT_EQ(scene.plant->step({}, 1e-3), StepStatus::Ok);
      const double way = std::fmod(600 + 1 + rate * tick * 1e-3, 6);  // straight on either side, and equally steep
      ASSERT_NEAR(observed(*scene.plant)[0].q[0], (way < 3 ? way : 6 - way) - 1, 1e-9) << tick;
    }
  }
}

// --- cusps

// A four-cusped star of 0.1 m: springs and a hand at rest, and every mass passes cusps of its own.
TEST(Cusps, AChainPassesThemWithoutGainingEnergy) {
  for (const bool side : {false, true}) {
    Experiment e = side ? makeExperiment(ObjectKind::Parallel, {0.4, 0.6}, {100, 140}) : makeChain(2, 0.5, 200, {150, 0});
    e = onCurve(e, "0.1*cos(phi)^3", "0.1*sin(phi)^3", "0");
    const Scene scene = compileScene(e);
    EXPECT_TRUE(holds(scene.choice.form, "speed along it"));
    scene.plant->place(std::array{0.7}, std::array{7.0});
    const HandSample hand{{0.02, 0.05, 0}, {}, true};
    const double before = scene.plant->energy(hand);
    double furthest = 0;
    for (int tick = 0; tick < 800; ++tick) {
      ASSERT_EQ(scene.plant->step(heldSegment(hand.position), 1e-3), StepStatus::Ok) << tick;
      furthest = std::max(furthest, std::abs(observed(*scene.plant)[1].q[0] - 0.7));
    }
    EXPECT_NEAR(scene.plant->energy(hand), before, 1e-9 * before);
    EXPECT_GT(furthest, std::numbers::pi / 2) << "it passed a cusp";
  }
}

TEST(Corners, EveryMassOfAChainRestsAndLeavesForItself) {
  Experiment e = onCurve(makeChain(2, 2, 50, {0, 0}), "phi/10", "0.1*abs(phi)", "0");
  e.object.gravity = {0, -9.81, 0};
  e.object.viscosity = 30;
  const Scene scene = freeScene(e, {0.5}, {0});
  ASSERT_EQ(run(*scene.plant, noHand, 3), StepStatus::Ok);
  for (const MassState& mass : observed(*scene.plant)) EXPECT_EQ(mass.q[0], 0);
  scene.plant->setExtraForce({2 * 9.81 * 1.2, 0, 0});  // less its own weight 3.92 N sideways, which the spring takes up
  ASSERT_EQ(run(*scene.plant, noHand, 3), StepStatus::Ok);
  const auto after = observed(*scene.plant);
  // Along the slope: (F - m g)/sqrt(2) against k d, with d the way up it.
  EXPECT_NEAR(norm(after[0].r), 0.2 * 2 * 9.81 / std::sqrt(2.0) / 50, 5e-4) << "up to where the spring holds it, but for e^-5 of the way";
  EXPECT_EQ(after[1].q[0], 0) << "the spring is too weak for the other";
  EXPECT_EQ(after[1].v, Vec3{});
}

TEST(Corners, TheMassThatComesFirstIsTold) {
  Experiment e = onCurve(makeChain(2, 0.5, 0, {0, 0}), "phi/10", "0.02*sign(phi - 0.5) + 0.05*abs(phi)", "0");
  for (const double pull : {1.0, -1.0}) {
    const Scene scene = freeScene(e, {0.2}, {1});
    scene.plant->setExtraForce({0.1 * pull, 0, 0});  // on the first
    EXPECT_EQ(run(*scene.plant, noHand, 1), StepStatus::AtEnd);
    EXPECT_TRUE(holds(scene.plant->stopReason(), pull > 0 ? "mass 1 at phi = 0.5 met" : "mass 2 at phi = 0.5 met"));
    EXPECT_NEAR(observed(*scene.plant)[pull > 0 ? 0 : 1].q[0], 0.5, 1e-12);
  }
}

// A hand that moves while masses pass corners and are thrown back: how long a tick is does not matter.
TEST(Corners, UnderAMovingHandEveryLengthOfATickComesToTheSame) {
  const Experiment kinks = onCurve(makeChain(2, 0.5, 200, {300, 4}), "phi/10", "0.05*abs(phi) + 0.02*sin(phi)", "0.03*abs(phi - 0.5)");
  const Experiment pair = makeChain(2, 0.5, 200, {300, 4}), ends = betweenEnds(pair, "bounce");
  const Experiment smooth = betweenEnds(pair, "bounce", "0.03*phi^2");
  const HandFunction hand = [](double t) {
    return HandSample{{0.1 + 0.25 * std::sin(7 * t), 0.1 + 0.1 * t, 0}, {0.25 * 7 * std::cos(7 * t), 0.1, 0}, true};
  };
  for (const Experiment& e : {kinks, ends, smooth}) {
    std::vector<std::vector<MassState>> came;
    for (const double dt : {1e-3, 2.5e-4}) {
      const Scene scene = compileScene(e, {"adaptive", dt, 0});
      scene.plant->placeAtRest(std::array{-0.3});
      ASSERT_EQ(run(*scene.plant, hand, 0.6, dt), StepStatus::Ok) << scene.plant->stopReason();
      came.push_back(observed(*scene.plant, hand(0.6)));
    }
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LT(norm(came[0][i].r - came[1][i].r), 1e-8) << e.constraint.definition << i;
      EXPECT_LT(norm(came[0][i].v - came[1][i].v), 1e-6) << e.constraint.definition << i;
    }
  }
}

// A step of 4 mm within two tenths of a thousandth of phi: it is passed along its whole length.
TEST(Corners, ANarrowStepOfACurveIsPassedAlongItsLength) {
  const Scene scene = freeScene(onCurve(makePoint(), "phi/10", "0.002*tanh(5000*(phi - 1))", "0"), {0.9}, {1});
  const double before = scene.plant->energy({}), speed = norm(observed(*scene.plant)[0].v);
  ASSERT_EQ(run(*scene.plant, noHand, 0.3), StepStatus::Ok);
  EXPECT_NEAR(scene.plant->energy({}) / before, 1, 1e-9);
  const double end = observed(*scene.plant)[0].q[0];
  EXPECT_GT(end, 1.01);
  const auto measure = [](double phi) {  // |r_phi|
    const double c = std::cosh(std::min(300.0, std::abs(5000 * (phi - 1))));
    return std::hypot(0.1, 10 / (c * c));
  };
  double length = 0;
  const auto add = [&](double a, double b, int parts) {  // Simpson's rule
    const double h = (b - a) / parts;
    for (int i = 0; i < parts; ++i) length += h / 6 * (measure(a + i * h) + 4 * measure(a + (i + 0.5) * h) + measure(a + (i + 1) * h));
  };
  add(0.9, 0.995, 10), add(0.995, 1.005, 40000), add(1.005, end, 10);
  EXPECT_NEAR(length, speed * 0.3, 1e-9);
}

// Towards the end of a root |r_phi| grows without bound: parameters are needed ever more exactly.
TEST(Corners, TowardsTheEndOfARootTheSpeedIsKept) {
  for (const char* y : {"sqrt(phi)/5", "phi^0.3/5", "sqrt(phi)/5 + 0.05*abs(phi - 0.3)"}) {
    const Scene scene = freeScene(from(onCurve(makePoint(), "phi/10", y, "0"), {0.5}, {1}), {0.5}, {-2});
    const double before = scene.plant->energy({});
    double nearest = 1;
    for (StepStatus status = StepStatus::Ok; status == StepStatus::Ok;) {
      status = scene.plant->step({}, 1e-3);
      EXPECT_TRUE(status == StepStatus::Ok || status == StepStatus::AtEnd) << describe(status);
      EXPECT_NEAR(scene.plant->energy({}) / before, 1, 1e-9) << y << " at " << observed(*scene.plant)[0].q[0];
      nearest = observed(*scene.plant)[0].q[0];
    }
    EXPECT_LT(nearest, 1e-3) << y;
  }
}

// Near-cusps by a hand that draws, by ticks of one length and of a quarter of it.
TEST(Cusps, HowLongATickIsDoesNotMatter) {
  for (const char* small : {"0.0198", "0.02"}) {
    const std::string d = small;
    Experiment e = onCurve(makePoint(1, {600, 5}), "0.08*cos(phi)-" + d + "*cos(4*phi)", "0.08*sin(phi)-" + d + "*sin(4*phi)", "0");
    const HandFunction hand = [](double t) {
      const MinimumJerk law = heldMinimumJerk(t / 0.7);
      const double phi = 1.05 + 2.2 * law.value, rate = 2.2 * law.rate / 0.7;
      return HandSample{{0.1 * std::cos(phi), 0.1 * std::sin(phi), 0}, {-0.1 * rate * std::sin(phi), 0.1 * rate * std::cos(phi), 0}, true};
    };
    std::vector<Vec3> places;
    for (const char* method : {"abm", "adaptive"})
      for (const double dt : {1e-3, 2.5e-4}) {
        const Scene scene = compileScene(e, {method, dt, 0});
        scene.plant->placeAtRest(std::array{1.3});
        ASSERT_EQ(run(*scene.plant, hand, 0.8, dt), StepStatus::Ok) << method << dt;
        places.push_back(observed(*scene.plant)[0].r);
      }
    for (const Vec3& place : places) EXPECT_LT(norm(place - places[0]), 1e-9) << d;
  }
}

/// Right-hand sides: of a tick on average, of the dearest, and how many ticks in a hundred are dearer than two sub-steps.
struct Price {
  double mean = 0, most = 0, dear = 0;
};
Price priceOf(const Scene& scene, const Vec3& hand, int ticks) {
  Price price;
  const std::uint64_t first = scene.plant->rhsEvaluations();
  for (int tick = 0; tick < ticks; ++tick) {
    const std::uint64_t before = scene.plant->rhsEvaluations();
    EXPECT_EQ(scene.plant->step(heldSegment(hand), 1e-3), StepStatus::Ok);
    const double spent = static_cast<double>(scene.plant->rhsEvaluations() - before);
    price.most = std::max(price.most, spent);
    price.dear += spent > 26 ? 100.0 / ticks : 0;
  }
  price.mean = static_cast<double>(scene.plant->rhsEvaluations() - first) / ticks;
  return price;
}

// Masses of one natural frequency move as one mass does, here through the cusp of (phi^2, phi^3) with rounding of their own.
TEST(Cusps, MassesThatArriveTogetherPassAsOne) {
  const auto placesOf = [](std::vector<double> masses, std::vector<double> stiffness, const char* method) {
    const Experiment e =
        onCurve(makeExperiment(ObjectKind::Parallel, std::move(masses), std::move(stiffness)), "0.1*phi^2", "0.1*phi^3", "0");
    const Scene scene = compileScene(e, {method, 1e-3, 0});
    scene.plant->placeAtRest(std::array{-0.8});
    const HandFunction hand = [](double t) {
      const MinimumJerk law = heldMinimumJerk(t / 1.35);
      const double phi = -0.8 + 1.6 * law.value, rate = 1.6 * law.rate / 1.35;
      return HandSample{{0.1 * phi * phi, 0.1 * phi * phi * phi, 0}, {0.2 * phi * rate, 0.3 * phi * phi * rate, 0}, true};
    };
    double furthest = -1;
    for (int tick = 0; tick < 1100; ++tick) {
      EXPECT_EQ(scene.plant->step(makeSegment(hand, tick * 1e-3, 1e-3), 1e-3), StepStatus::Ok) << scene.plant->stopReason();
      furthest = std::max(furthest, observed(*scene.plant)[0].q[0]);
    }
    EXPECT_GT(furthest, 0.2) << "behind the cusp";
    std::vector<Vec3> places;
    for (const MassState& mass : observed(*scene.plant)) places.push_back(mass.r);
    return places;
  };
  const Vec3 one = placesOf({1}, {100}, "adaptive").at(0);
  for (const char* method : {"abm", "adaptive"})
    for (const Vec3& place : placesOf({1, 3, 2}, {100, 300, 200}, method)) EXPECT_LT(norm(place - one), 1e-9) << method;
}

// What is promised of hard curves (near-cusps of 1 % and 0.1 %, a cusp, and a flat ellipse): the energy of free motion, one or two
// right-hand sides a tick where nothing is hard (twelve by sub-steps), and a tick that passes a cusp far below the thousand that cap it.
TEST(Cusps, ArePassedWithinTheirBudget) {
  struct Case {
    const char *x, *y;
    double phi, rate;
    Price abm, adaptive;
  };
  for (const Case& c :
       {Case{"0.08*cos(phi)-0.0198*cos(4*phi)", "0.08*sin(phi)-0.0198*sin(4*phi)", 1.047, 9, {12.5, 370, 6}, {16.5, 370, 6}},
        Case{"0.08*cos(phi)-0.01998*cos(4*phi)", "0.08*sin(phi)-0.01998*sin(4*phi)", 1.047, 9, {12.5, 420, 5}, {16.5, 420, 5}},
        Case{"0.08*cos(phi)-0.02*cos(4*phi)", "0.08*sin(phi)-0.02*sin(4*phi)", 0.5, 4, {3.8, 100, 0.3}, {12.5, 100, 0.3}},
        Case{"0.1*cos(phi)", "0.0001*sin(phi)", 0.8, 8, {5.2, 380, 1}, {13.5, 380, 1}}})
    for (const bool steps : {false, true}) {
      const Scene scene = freeScene(onCurve(makePoint(), c.x, c.y, "0"), {c.phi}, {c.rate}, steps ? "adaptive" : "abm");
      const double before = scene.plant->energy({});
      const Price price = priceOf(scene, {}, 2000), most = steps ? c.adaptive : c.abm;
      EXPECT_NEAR(scene.plant->energy({}) / before, 1, 1e-10) << c.x << steps;
      EXPECT_LE(price.mean, most.mean) << c.x << steps;
      EXPECT_LE(price.most, most.most) << c.x << steps;
      EXPECT_LE(price.dear, most.dear) << c.x << steps;
      EXPECT_GE(price.mean, steps ? 12 : 1) << c.x;
    }
  const Scene star =
      compileScene(onCurve(makeChain(2, 0.5, 200, {150, 0}), "0.1*cos(phi)^3", "0.1*sin(phi)^3", "0"), {"adaptive", 1e-3, 0});
  star.plant->place(std::array{0.7}, std::array{7.0});
  const Price price = priceOf(star, {0.02, 0.05, 0}, 800);
  EXPECT_LE(price.mean, 15);
  EXPECT_LE(price.most, 175);
  EXPECT_LE(price.dear, 5);
  // Five masses that pass a cusp within few ticks.
  const Scene row = compileScene(onCurve(makeChain(5, 0.6, 600, {600, 0}), "0.1*phi^2", "0.1*phi^3", "0"), {"adaptive", 1e-3, 0});
  row.plant->place(std::array{-0.5}, std::array{4.0});
  const HandSample hand{{0.025, -0.0125, 0}, {}, true};
  const double before = row.plant->energy(hand);
  EXPECT_LE(priceOf(row, hand.position, 400).most, 2500);
  EXPECT_NEAR(row.plant->energy(hand) / before, 1, 1e-9);
}

}  // namespace
}  // namespace reachlab::dynamics
