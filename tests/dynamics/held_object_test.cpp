#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "constraints/constraint.h"
#include "sim/dynamics/shared_plant.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/held_segment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

using experiment::Experiment;
using experiment::ObjectKind;

/// Three unlike masses held at the first, at the last, and by springs to all.
Experiment chainOfThree() {
  Experiment e = makeExperiment(ObjectKind::Chain, {0.5, 0.8, 0.3}, {300, 200}, {600, 5});
  e.object.damping = {2, 3};
  e.object.viscosity = 0.7;
  e.object.gravity = {0.4, -9.81, 1.2};
  e.hands = {{1, {400}, {4}, {}}, {3, {250}, {1.5}, {}}, {0, {50, 100, 150}, {1, 0.5, 2}, {}}};
  return e;
}
Experiment bodyOf(std::vector<experiment::Hand> hands) {
  Experiment e = makeBody();
  e.hands = std::move(hands);
  return e;
}

HandSample handAt(int k) { return {{0.1 - 0.2 * k, 0.3 + 0.1 * k, -0.2 * k}, {0.5 * k - 0.3, 0.2, 0.4 - 0.1 * k}, true}; }
constexpr std::array kGrip{1.0, 0.6, 0.25};

/// Force of the experiment's hand h on mass i, Eq. (8) scaled by its grip.
Vec3 pull(const HandSprings& springs, const HandSample& hand, double grip, const MassState& mass, std::size_t i) {
  return grip * (springs.stiffness[i] * (hand.position - mass.r) + springs.damping[i] * (hand.velocity - mass.v));
}

/// The plant with every hand told where it is, its masses apart and in motion.
Scene inMotion(const Experiment& e) {
  Scene scene = compileScene(e);
  SharedPlant& plant = *scene.shared;
  std::vector<double> places(plant.placeCount()), rates(plant.rateCount());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = 0.3 + 0.17 * static_cast<double>(i) - 0.02 * static_cast<double>(i * i);
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = 0.4 - 0.23 * static_cast<double>(i) + 0.03 * static_cast<double>(i * i);
  plant.placeAtRest(std::vector<double>(e.constraint.name == "free" ? 3 : 1, 0.2));
  plant.show(places, rates);
  for (int h = 1; h < plant.handCount(); ++h) {
    HandSegment moving = heldSegment(handAt(h).position);
    moving.degree = 2;
    moving.position[2] = {0.01, -0.02, 0.03}, moving.velocity[1] = {0.3, 0.2, 0.1};
    plant.setHand(h, moving, handAt(h), kGrip[h]);
  }
  return scene;
}

/// All forces on mass i but the constraint's own, added up here.
Vec3 forceOn(const Experiment& e, const std::vector<MassState>& m, std::size_t i, const Vec3& extra) {
  const experiment::Object& o = e.object;
  Vec3 f = o.masses[i] * o.gravity - o.viscosity * m[i].v;
  if (i == 0) f += extra;
  if (i > 0) f += o.stiffness[i - 1] * (m[i - 1].r - m[i].r) + o.damping[i - 1] * (m[i - 1].v - m[i].v);
  if (i + 1 < m.size()) f += o.stiffness[i] * (m[i + 1].r - m[i].r) + o.damping[i] * (m[i + 1].v - m[i].v);
  const std::vector<HandSprings> hands = handSpringsOf(e);
  for (std::size_t h = 0; h < hands.size(); ++h) f += pull(hands[h], handAt(static_cast<int>(h)), kGrip[h], m[i], i);
  return f;
}

TEST(HeldObject, FreeMassesAreAcceleratedByAllTheirForces) {
  const Experiment e = free(chainOfThree());
  const Scene scene = inMotion(e);
  const Vec3 extra{1.5, -0.4, 0.8};
  scene.plant->setExtraForce(extra);
  const std::vector<MassState> m = observed(*scene.plant, handAt(0));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(norm(m[i].a - forceOn(e, m, i, extra) / e.object.masses[i]), 1e-12) << i;

  std::vector<double> more(9);
  for (std::size_t i = 0; i < 9; ++i) more[i] = 0.1 * static_cast<double>(i) - 0.35;
  scene.shared->setExtraAcceleration(more);
  const std::vector<MassState> pushed = observed(*scene.plant, handAt(0));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(norm(pushed[i].a - m[i].a - Vec3{more[3 * i], more[3 * i + 1], more[3 * i + 2]}), 1e-13) << i;
}

// On a curve what the forces leave is across it, and the acceleration is the second derivative of r(phi(t)).
TEST(HeldObject, MassesOnACurveAreAcceleratedByWhatIsAlongIt) {
  const Experiment e = onLoop(chainOfThree());
  const Scene scene = inMotion(e);
  const Vec3 extra{1.5, -0.4, 0.8};
  scene.plant->setExtraForce(extra);
  const std::vector<MassState> m = observed(*scene.plant, handAt(0));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(m[i].q[0], scene.shared->places()[i]);
    EXPECT_EQ(m[i].q[1], 0);
    EXPECT_EQ(m[i].qRate[0], scene.shared->rates()[i]);
    EXPECT_EQ(m[i].qRate[1], 0);
    const constraints::CurvePoint p = constraints::evaluate(scene.constraint->curve, m[i].q[0]);
    EXPECT_LT(norm(m[i].r - p.r), 1e-16);
    EXPECT_LT(norm(m[i].v - m[i].qRate[0] * p.rPhi), 1e-16);
    EXPECT_NEAR(dot(p.rPhi, m[i].a - forceOn(e, m, i, extra) / e.object.masses[i]), 0, 1e-12) << i;
    const Vec3 left = m[i].a - m[i].qRate[0] * m[i].qRate[0] * p.rPhiPhi;
    EXPECT_LT(norm(cross(left, p.rPhi)), 1e-12) << "but for the bend it is along the curve, " << i;
  }
}

TEST(HeldObject, AHandsForceIsTheSumOverTheMassesThatItHolds) {
  const Experiment e = free(chainOfThree());
  const Scene scene = inMotion(e);
  const std::vector<HandSprings> hands = handSpringsOf(e);
  const std::vector<MassState> m = observed(*scene.plant, handAt(0));
  for (int h = 0; h < 3; ++h) {
    Vec3 sum;
    for (std::size_t i = 0; i < 3; ++i) sum += pull(hands[h], handAt(h), kGrip[h], m[i], i);
    EXPECT_LT(norm(scene.shared->couplingForceOf(h) - sum), 1e-12) << h;
  }
  EXPECT_EQ(scene.plant->couplingForce(handAt(0)), scene.shared->couplingForceOf(0));
  scene.plant->setCoupled(false);
  for (int h = 0; h < 3; ++h) EXPECT_EQ(scene.shared->couplingForceOf(h), Vec3{});
}

TEST(HeldObject, IsHeldAtTheMeanOfItsMassesByTheirStiffness) {
  Experiment e = free(chainOfThree());
  const Scene scene = inMotion(e);
  const std::vector<MassState> m = observed(*scene.plant);
  EXPECT_LT(norm(scene.shared->fixedPoint(0) - m[0].r), 1e-15);
  EXPECT_LT(norm(scene.shared->fixedPoint(1) - m[2].r), 1e-15);
  EXPECT_LT(norm(scene.shared->fixedPoint(2) - (50 * m[0].r + 100 * m[1].r + 150 * m[2].r) / 300), 1e-15);
  e.hands[1] = {3, {0}, {1}, {}};
  const Scene loose = inMotion(e);
  EXPECT_EQ(loose.shared->fixedPoint(1), observed(*loose.plant)[0].r) << "a hand without a spring is told mass 1";
}

TEST(HeldObject, EnergiesAreThoseOfMotionSpringsAndHeight) {
  for (const Experiment& e : {free(chainOfThree()), onLoop(chainOfThree())}) {
    const Scene scene = inMotion(e);
    const std::vector<MassState> m = observed(*scene.plant);
    const std::vector<HandSprings> hands = handSpringsOf(e);
    double kinetic = 0, height = 0, springs = 0, held = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      kinetic += e.object.masses[i] * dot(m[i].v, m[i].v) / 2;
      height -= e.object.masses[i] * dot(e.object.gravity, m[i].r);
      if (i < 2) springs += e.object.stiffness[i] * dot(m[i + 1].r - m[i].r, m[i + 1].r - m[i].r) / 2;
      for (int h = 0; h < 3; ++h) {
        const Vec3 stretch = handAt(h).position - m[i].r;
        held += kGrip[h] * hands[h].stiffness[i] * dot(stretch, stretch) / 2;
      }
    }
    const Vec3 start = e.constraint.name == "free" ? Vec3{0.2, 0.2, 0.2} : constraints::evaluate(scene.constraint->curve, 0.2).r;
    const double heightAtStart = -1.6 * dot(e.object.gravity, start);
    EXPECT_NEAR(scene.shared->kineticEnergy(), kinetic, 1e-13);
    EXPECT_NEAR(scene.shared->objectEnergy(), kinetic + springs + height - heightAtStart, 1e-12) << "height is counted from the start";
    EXPECT_NEAR(scene.plant->energy(handAt(0)), kinetic + springs + height + held, 1e-12);
    scene.plant->setCoupled(false);
    EXPECT_NEAR(scene.plant->energy(handAt(0)), kinetic + springs + height, 1e-12);
  }
}

TEST(HeldObject, TwoCopiesLieApartByTheMeanSquareOfTheirMasses) {
  const Scene scene = inMotion(free(chainOfThree()));
  const std::vector<double> a(9, 0.0), b{0.3, 0, 0, 0, 0.4, 0, 0, 0, 1.2};
  EXPECT_NEAR(scene.shared->distanceBetween(a, b), std::sqrt((0.09 + 0.16 + 1.44) / 3), 1e-15);
  const Scene loop = inMotion(onLoop(chainOfThree()));
  const std::vector<double> c{0.1, 0.2, 0.3}, d{0.5, 0.2, -0.4};
  double squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 apart = constraints::evaluate(loop.constraint->curve, c[i]).r - constraints::evaluate(loop.constraint->curve, d[i]).r;
    squares += dot(apart, apart);
  }
  EXPECT_NEAR(loop.shared->distanceBetween(c, d), std::sqrt(squares / 3), 1e-15);
  std::vector<double> by(3);
  loop.shared->difference(d, by);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(by[i], d[i] - loop.shared->places()[i]);
}

// What was done to it is forgotten: work, grip, a push, and where the hands were.
TEST(HeldObject, PutUpAnewItMovesAsANewOneDoes) {
  for (const Experiment& e :
       {free(chainOfThree()), onLoop(chainOfThree()), bodyOf({{1, {300}, {2}, {0.05, 0, 0.01}}, {1, {600}, {1}, {0, 0.1, 0}}})}) {
    const std::vector<double> start(e.constraint.name == "free" ? 3 : 1, 0.3);
    const Scene used = inMotion(e), fresh = compileScene(e);
    used.shared->setExtraAcceleration(std::vector<double>(static_cast<std::size_t>(used.shared->rateCount()), 2.0));
    (void)run(*used.plant, handAt(0), 0.02);
    EXPECT_NE(used.shared->work(0), 0);
    for (const Scene* s : {&used, &fresh}) {
      s->plant->placeAtRest(start);
      for (int h = 0; h < s->shared->handCount(); ++h) {
        EXPECT_EQ(s->shared->work(h), 0);
        EXPECT_LT(norm(s->shared->couplingForceOf(h)), 1e-9) << "hands rest at the object's start";
      }
      ASSERT_EQ(run(*s->plant, handAt(0), 0.05), StepStatus::Ok);
      EXPECT_GT(norm(s->shared->couplingForceOf(1)), 1e-3) << "and stay there";
    }
    const auto a = used.shared->places(), b = fresh.shared->places(), c = used.shared->rates(), d = fresh.shared->rates();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin()));
    EXPECT_TRUE(std::equal(c.begin(), c.end(), d.begin()));
    for (int h = 0; h < used.shared->handCount(); ++h) EXPECT_EQ(used.shared->work(h), fresh.shared->work(h));
    EXPECT_EQ(used.shared->rhsEvaluations() - fresh.shared->rhsEvaluations(), 4u * 20) << "four a step";
  }
}

TEST(HeldObject, ANumberThatIsNoneEndsTheStepAndNotTheState) {
  for (const Experiment& e : {free(chainOfThree()), onLoop(chainOfThree())}) {
    const Scene scene = inMotion(e);
    const std::vector<double> places(scene.shared->places().begin(), scene.shared->places().end());
    const std::vector<double> rates(scene.shared->rates().begin(), scene.shared->rates().end());
    EXPECT_EQ(scene.plant->step(heldSegment({0, std::numeric_limits<double>::quiet_NaN(), 0}), 1e-3), StepStatus::NotFinite);
    EXPECT_EQ(std::vector<double>(scene.shared->places().begin(), scene.shared->places().end()), places);
    EXPECT_EQ(std::vector<double>(scene.shared->rates().begin(), scene.shared->rates().end()), rates);
    EXPECT_EQ(scene.plant->step(heldSegment({}), 1e-3), StepStatus::Ok);
  }
}

TEST(HeldObject, AtAnEndTheStateIsTheLastOneOnTheCurve) {
  for (const double side : {1.0, -1.0}) {
    Experiment e = onDefinition(chainOfThree(), "curve", R"(["0.1*phi", "0.1*phi^2", "0"])", "[-1, 1]", "stop");
    e.object.gravity = {};
    const Scene scene = compileScene(e);
    scene.plant->place(std::array{0.0}, std::array{20 * side});
    scene.plant->setCoupled(false);
    std::vector<double> before;
    StepStatus status = StepStatus::Ok;
    for (int tick = 0; tick < 200 && status == StepStatus::Ok; ++tick) {
      EXPECT_EQ(scene.plant->stopReason(), "");
      EXPECT_EQ(scene.plant->lastStepFraction(), 1);
      before.assign(scene.shared->places().begin(), scene.shared->places().end());
      status = scene.plant->step({}, 1e-3);
    }
    EXPECT_EQ(status, StepStatus::AtEnd);
    EXPECT_EQ(scene.plant->lastStepFraction(), 0);
    EXPECT_EQ(scene.plant->stopReason(), "a mass reached the end of the constraint's domain");
    EXPECT_TRUE(std::equal(before.begin(), before.end(), scene.shared->places().begin()));
    EXPECT_GT(before[0] * side, 0.97);
    const std::vector<double> onEnd(3, side), still(3, 0.0);
    scene.shared->show(onEnd, still);
    scene.plant->setExtraForce({});
    EXPECT_EQ(scene.plant->step({}, 1e-3), StepStatus::Ok) << "the end itself belongs to it";
    scene.plant->placeAtRest(std::array{0.0});
    EXPECT_EQ(scene.plant->lastStepFraction(), 1);
    EXPECT_EQ(scene.plant->stopReason(), "");
  }
}

// A body held at two places: what the hands do turns and moves it. The trapezium rule over a tick errs by 1e-5 of it.
TEST(HeldObject, TheWorkOfTwoHandsOnABodyIsItsEnergy) {
  const Scene scene = compileScene(bodyOf({{1, {300}, {2}, {0.05, 0.02, -0.01}}, {1, {500}, {0}, {-0.04, 0.1, 0.03}}}));
  const std::array start{0.1, 0.2, -0.1};
  scene.plant->placeAtRest(start);
  for (const int h : {0, 1}) {
    const Vec3 offset = h == 0 ? Vec3{0.05, 0.02, -0.01} : Vec3{-0.04, 0.1, 0.03};
    EXPECT_LT(norm(scene.shared->fixedPoint(h) - Vec3{0.1, 0.2, -0.1} - offset), 1e-16) << "where it holds the body";
  }
  const Vec3 first = scene.shared->fixedPoint(0), second = scene.shared->fixedPoint(1);
  const HandFunction left = [&](double t) {
    return HandSample{first + std::sin(3 * t) * Vec3{0.05, 0.02, 0.03}, 3 * std::cos(3 * t) * Vec3{0.05, 0.02, 0.03}, true};
  };
  const HandFunction right = [&](double t) {
    return HandSample{second - std::sin(4 * t) * Vec3{0.02, 0.03, 0.06}, -4 * std::cos(4 * t) * Vec3{0.02, 0.03, 0.06}, true};
  };
  double most = 0, turned = 0;
  for (int tick = 0; tick < 600; ++tick) {
    scene.shared->setHand(1, makeSegment(right, tick * 1e-3, 1e-3), right((tick + 1) * 1e-3));
    ASSERT_EQ(scene.plant->step(makeSegment(left, tick * 1e-3, 1e-3), 1e-3), StepStatus::Ok);
    const double energy = scene.shared->objectEnergy();
    most = std::max(most, energy);
    turned = std::max(turned, norm(scene.plant->body().angularVelocity));
    EXPECT_NEAR(scene.shared->work(0) + scene.shared->work(1), energy, 2e-5) << tick;
    const auto places = scene.shared->places();
    EXPECT_NEAR(places[3] * places[3] + places[4] * places[4] + places[5] * places[5] + places[6] * places[6], 1, 1e-15);
  }
  EXPECT_GT(most, 0.02);
  EXPECT_GT(turned, 0.3);
}

TEST(HeldObject, ABodysAngularVelocityIsToldInTheWorld) {
  const Scene scene = compileScene(bodyOf({{1, {300}, {2}, {0.05, 0.02, -0.01}}, {1, {500}, {0}, {}}}));
  const double half = 0.4;  // turned about x
  const std::vector<double> places{0.1, 0.2, -0.1, std::cos(half), std::sin(half), 0, 0}, rates(6, 0.0);
  scene.shared->show(places, rates);
  scene.plant->setAngularVelocity({1, 2, 3});
  EXPECT_LT(norm(scene.plant->body().angularVelocity - Vec3{1, 2, 3}), 1e-15);
  const double c = std::cos(0.8), s = std::sin(0.8);
  const auto own = scene.shared->rates();
  EXPECT_NEAR(own[3], 1, 1e-15);
  EXPECT_NEAR(own[4], c * 2 + s * 3, 1e-15) << "in its own axes";
  EXPECT_NEAR(own[5], -s * 2 + c * 3, 1e-15);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(scene.plant->body().orientation[i], places[3 + i]);
  const auto& inertia = bodyOf({}).object.inertia;
  double turning = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) turning += inertia[i][j] * own[3 + i] * own[3 + j] / 2;
  EXPECT_NEAR(scene.shared->kineticEnergy(), turning, 1e-15);
}

// From one orientation to another by a small turn about a body axis: the vector of that turn.
TEST(HeldObject, TheDifferenceOfTwoOrientationsIsTheTurnBetweenThemInBodyAxes) {
  const Scene scene = compileScene(bodyOf({{1, {300}, {2}, {}}, {1, {500}, {0}, {}}}));
  const double w = 0.5, x = 0.5, y = -0.1, z = std::sqrt(1 - 0.51);
  scene.shared->show(std::vector<double>{0, 0, 0, w, x, y, z}, std::vector<double>(6, 0.0));
  const std::array turn{0.02, -0.05, 0.03};
  const double angle = std::hypot(turn[0], turn[1], turn[2]), c = std::cos(angle / 2), s = std::sin(angle / 2) / angle;
  const double a = s * turn[0], b = s * turn[1], d = s * turn[2];  // q (c, a, b, d)
  const std::vector<double> there{0.1,
                                  0.2,
                                  0.3,
                                  w * c - x * a - y * b - z * d,
                                  w * a + x * c + y * d - z * b,
                                  w * b - x * d + y * c + z * a,
                                  w * d + x * b - y * a + z * c};
  std::vector<double> by(6);
  scene.shared->difference(there, by);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(by[i], 0.1 * static_cast<double>(i + 1), 1e-15);
    EXPECT_NEAR(by[3 + i], 2 * s * turn[i], 1e-15);
  }
  std::vector<double> negative = there, same(6);
  for (std::size_t i = 3; i < 7; ++i) negative[i] = -negative[i];
  scene.shared->difference(negative, same);
  EXPECT_EQ(by, same) << "a quaternion and its negative are one orientation";
}

}  // namespace
}  // namespace reachlab::dynamics
