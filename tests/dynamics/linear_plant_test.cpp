#include "sim/dynamics/exact/linear_plant.h"

#include <gtest/gtest.h>

#include "sim/dynamics/compile.h"
#include "sim/dynamics/hand/hand_path.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/held_segment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

using experiment::ObjectKind;

/// An object with nothing equal: what its modes would diagonalise they do not.
ObjectModel unlike(ObjectKind kind, int n) {
  ObjectModel m;
  m.kind = kind;
  m.viscosity = 0.4;
  m.gravity = {0.7, -9.81, 1.3};
  for (int i = 0; i < n; ++i) {
    m.mass.push_back(0.4 + 0.3 * (i % 3));
    const bool held = kind == ObjectKind::Parallel || i == 0;
    m.handStiffness.push_back(held ? 500 + 70 * i : 0);
    m.handDamping.push_back(held ? 5 - i % 3 : 0);
    if (kind == ObjectKind::Chain && i + 1 < n) m.stiffness.push_back(300 + 50 * i), m.damping.push_back(2 + i % 2);
  }
  return m;
}
/// The same with every mass alike and no damper but the medium: a chain goes by its modes.
ObjectModel alike(int n, double viscosity, const Vec3& gravity) {
  ObjectModel m = unlike(ObjectKind::Chain, n);
  m.mass.assign(static_cast<std::size_t>(n), 0.5);
  m.damping.assign(static_cast<std::size_t>(n) - 1, 0);
  m.handDamping[0] = 0;
  m.viscosity = viscosity;
  m.gravity = gravity;
  return m;
}

/// Aslant, with its origin elsewhere and 0.14 m to a unit of phi.
LinearSpace slanted() { return {1, {0.3, -0.1, 0.2}, {0.06, -0.04, 0.12}, {}}; }
LinearSpace alongX() { return {1, {0.3, -0.1, 0.2}, {0.2, 0, 0}, {}}; }
LinearSpace space() { return {3, {}, {}, {}}; }

HandSample swinging(double t) {
  return {{0.3 + 0.1 * std::sin(3 * t), 0.1 * std::cos(4 * t), 0.2 - 0.1 * std::sin(2 * t)},
          {0.3 * std::cos(3 * t), -0.4 * std::sin(4 * t), -0.2 * std::cos(2 * t)},
          true};
}

void expectSame(const Plant& exact, const Plant& other, const HandSample& hand, double within) {
  const std::vector<MassState> a = observed(exact, hand), b = observed(other, hand);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT(norm(a[i].r - b[i].r), within) << "mass " << i + 1;
    EXPECT_LT(norm(a[i].v - b[i].v), 100 * within) << "mass " << i + 1;
    EXPECT_LT(norm(a[i].a - b[i].a), 1e4 * within) << "mass " << i + 1;
    EXPECT_NEAR(a[i].q[0], b[i].q[0], 10 * within);
    EXPECT_NEAR(a[i].qRate[0], b[i].qRate[0], 1000 * within);
  }
  EXPECT_LT(norm(exact.couplingForce(hand) - other.couplingForce(hand)), 1e4 * within);
  EXPECT_NEAR(exact.energy(hand), other.energy(hand), 1e4 * within);
}

/// Held, pushed, let go and held again: by the matrix exponential and by sub-steps of the equations of motion.
void expectExact(const ObjectModel& model, const LinearSpace& where) {
  const auto exact = makeExactPlant(model, where, 1e-3);
  const auto other = where.axes == 1 ? makeLinePlant(model, where, {"adaptive", 0}) : makeFreePlant(model, {"adaptive", 0});
  double t = 0;
  const auto both = [&](auto act) { act(*exact), act(*other); };
  const auto go = [&](int ticks) {
    for (int i = 0; i < ticks; ++i, t += 1e-3)
      both([&](Plant& p) { ASSERT_EQ(p.step(makeSegment(swinging, t, 1e-3), 1e-3), StepStatus::Ok); });
    expectSame(*exact, *other, swinging(t), 1e-10);
  };
  both([](Plant& p) { p.place(std::array{0.2, -0.1, 0.3}, std::array{0.5, 0.4, -0.7}); });
  expectSame(*exact, *other, swinging(0), 1e-14);
  go(40);
  both([](Plant& p) { p.setExtraForce({1.5, -2, 0.8}); });
  go(40);
  both([](Plant& p) { p.setCoupled(false); });
  go(40);
  both([](Plant& p) { p.setExtraForce({}); });
  go(20);
  both([](Plant& p) { p.setCoupled(true); });
  go(40);
  for (const double dt : {5e-4, 1e-3, 2e-4}) {  // the last row of a simulation is shorter
    both([&](Plant& p) { ASSERT_EQ(p.step(makeSegment(swinging, t, dt), dt), StepStatus::Ok); });
    t += dt;
    expectSame(*exact, *other, swinging(t), 1e-10);
  }
}

TEST(LinearPlant, ChainsOfAnyCountMoveAsTheirEquationsSay) {
  for (int n = 1; n <= 9; ++n) {
    SCOPED_TRACE(n);
    expectExact(unlike(n == 1 ? ObjectKind::Point : ObjectKind::Chain, n), slanted());
  }
}

TEST(LinearPlant, EveryObjectMovesInSpaceAndAlongXAsItsEquationsSay) {
  for (const LinearSpace& where : {alongX(), space()}) {
    SCOPED_TRACE(where.axes);
    expectExact(unlike(ObjectKind::Point, 1), where);
    expectExact(unlike(ObjectKind::Chain, 2), where);
    expectExact(unlike(ObjectKind::Chain, 5), where);
    expectExact(unlike(ObjectKind::Parallel, 3), where);
    expectExact(alike(3, 0.7, {0.7, -9.81, 1.3}), where);
    expectExact(alike(6, 0, {}), where);
  }
}

TEST(LinearPlant, ParallelMassesAndModesMoveAslantAsTheirEquationsSay) {
  for (const int n : {1, 2, 4, 5, 6}) expectExact(unlike(ObjectKind::Parallel, n), slanted());
  for (const int n : {3, 4, 5, 9}) expectExact(alike(n, 0.7, {0.7, -9.81, 1.3}), slanted());
  for (const int n : {3, 8}) expectExact(alike(n, 0, {}), slanted());
  ObjectModel damped = alike(5, 0, {0, 0, 2});  // in proportion to the stiffness, hand and all
  for (std::size_t i = 0; i < 4; ++i) damped.damping[i] = 0.01 * damped.stiffness[i];
  damped.handDamping[0] = 0.01 * damped.handStiffness[0];
  expectExact(damped, slanted());
}

// Many undamped masses, side by side (each a mode of its own, with a mass that is not 1) and in a chain of more than 128.
TEST(LinearPlant, ManyMassesMoveAsTheirEquationsSay) {
  for (const ObjectKind kind : {ObjectKind::Parallel, ObjectKind::Chain}) {
    ObjectModel model = unlike(kind, 130);
    model.viscosity = 0;
    model.gravity = {};
    model.damping.assign(model.damping.size(), 0), model.handDamping.assign(130, 0);
    const auto exact = makeExactPlant(model, slanted(), 1e-3);
    const auto other = makeLinePlant(model, slanted(), {"adaptive", 0});
    for (Plant* p : {exact.get(), other.get()}) {
      p->place(std::array{0.2}, std::array{0.5});
      ASSERT_EQ(run(*p, swinging, 0.03), StepStatus::Ok);
    }
    expectSame(*exact, *other, swinging(0.03), 1e-11);
  }
}

// A cubic path and a held one as well as a smooth hand's seventh degree. The hand of 128 masses is slower, because their slow modes magnify the
// rounding of its third derivative. Where it is also smoother, the free form takes its fourth and fifth.
TEST(LinearPlant, AHandOfAnyDegreePullsAsTheEquationsSay) {
  const struct {
    ObjectModel model;
    double slower = 1, smoother = 1;  // factors of all coefficients but the place, and of each beside the one before
  } rows[] = {{unlike(ObjectKind::Chain, 3)},
              {unlike(ObjectKind::Parallel, 3)},
              {alike(4, 0, {})},
              {alike(128, 0, {}), 1e-4},
              {alike(128, 0, {}), 1, 1e-4}};
  for (const auto& [model, slower, smoother] : rows)
    for (int degree = 0; degree <= HandSegment::kMaxDegree; ++degree) {
      SCOPED_TRACE(degree);
      const auto exact = makeExactPlant(model, slanted(), 1e-3);
      const auto other = makeLinePlant(model, slanted(), {"adaptive", 0});
      for (Plant* p : {exact.get(), other.get()}) p->placeAtRest(std::array{0.2});
      HandSegment hand;
      hand.degree = degree;
      for (int k = 0; k <= degree; ++k) {
        const double factor = k == 0 ? 1 : slower * std::pow(smoother, k - 1);
        hand.position[k] = factor * Vec3{0.3 + 0.01 * k, 0.2 - 0.02 * k, 0.03 * k};
        hand.velocity[k] = {5.0 - k, 3 + 2.0 * k, 7 - 3.0 * k};
      }
      for (int tick = 0; tick < 20; ++tick)
        for (Plant* p : {exact.get(), other.get()}) ASSERT_EQ(p->step(hand, 1e-3), StepStatus::Ok);
      expectSame(*exact, *other, endOf(hand), 1e-11);
    }
}

// A hand that comes as samples is a polynomial of any degree up to a cubic. From 128 masses on free modes turn in a form of their own.
TEST(LinearPlant, ModesAndMatrixAgreeForAHandOfEveryDegree) {
  for (const int count : {20, 130}) {
    experiment::Experiment modal = makeChain(count, 0.15, 600), matrix = modal;
    matrix.object.damping.assign(static_cast<std::size_t>(count) - 1, 0.0);
    matrix.object.damping[3] = 1e-9;
    const Scene a = compileScene(modal), b = compileScene(matrix);
    for (const int samples : {1, 2, 3, 4}) {
      HandPath path(samples);
      for (const Scene* scene : {&a, &b}) scene->plant->placeAtRest(std::array{0.0});
      for (int i = 0; i < 500; ++i) {
        path.push(reachAt(i * 1e-3));
        for (const Scene* scene : {&a, &b}) ASSERT_EQ(scene->plant->step(path.segment(), 1e-3), StepStatus::Ok);
      }
      const auto ma = observed(*a.plant), mb = observed(*b.plant);
      for (int i = 0; i < count; ++i) EXPECT_NEAR(ma[i].r.x, mb[i].r.x, 1e-11) << samples << " samples, mass " << i + 1 << " of " << count;
    }
  }
}

TEST(LinearPlant, AnHourOfTheUndampedChainKeepsItsEnergy) {
  const Scene scene = compileScene(makeChain(5, 0.6, 600));
  scene.plant->place(std::array{0.0}, std::array{10.0});
  const HandSample hand{{-0.1, 0, 0}, {}, true};
  const double before = scene.plant->energy(hand);
  const HandSegment held = heldSegment(hand.position);
  for (int i = 0; i < 3600000; ++i) ASSERT_EQ(scene.plant->step(held, 1e-3), StepStatus::Ok);
  EXPECT_NEAR(scene.plant->energy(hand) / before, 1, 1e-9) << "3.6 million roundings of 1e-16";
}

TEST(LinearPlant, OnlyADampedHandNeedsItsVelocity) {
  EXPECT_FALSE(makeExactPlant(alike(4, 1, {}), slanted(), 1e-3)->needsHandVelocity());
  EXPECT_TRUE(makeExactPlant(unlike(ObjectKind::Chain, 4), slanted(), 1e-3)->needsHandVelocity());
  ObjectModel last = unlike(ObjectKind::Parallel, 3);
  last.handDamping = {0, 0, 1};
  EXPECT_TRUE(makeExactPlant(last, slanted(), 1e-3)->needsHandVelocity());
}

// Of three masses and more in modes the first and last can be read alone, to the bit what all of them give.
TEST(LinearPlant, TheEndsOfAChainAreThoseThatAreSeenWithAllMasses) {
  for (const LinearSpace& where : {slanted(), space()}) {
    const auto plant = makeExactPlant(alike(5, 0.7, {1, 2, 3}), where, 1e-3);
    const auto* ends = dynamic_cast<const EndMasses*>(plant.get());
    ASSERT_NE(ends, nullptr);
    plant->place(std::array{0.2, -0.1, 0.3}, std::array{0.5, 0.4, -0.7});
    for (int tick = 0; tick < 30; ++tick) {
      if (tick == 15) plant->setCoupled(false);
      ASSERT_EQ(plant->step(makeSegment(swinging, tick * 1e-3, 1e-3), 1e-3), StepStatus::Ok);
      std::vector<MassState> two(5);
      two[2].r = {7, 8, 9};
      ASSERT_TRUE(ends->observeEnds(two));
      const Vec3 force = plant->couplingForce(swinging(tick * 1e-3));
      const std::vector<MassState> all = observed(*plant);
      for (const std::size_t i : {0u, 4u}) {
        EXPECT_EQ(two[i].r, all[i].r);
        EXPECT_EQ(two[i].v, all[i].v);
        EXPECT_EQ(two[i].q, all[i].q);
        EXPECT_EQ(two[i].qRate, all[i].qRate);
      }
      EXPECT_EQ(two[2].r, (Vec3{7, 8, 9})) << "the others stay as they were";
      EXPECT_EQ(force, plant->couplingForce(swinging(tick * 1e-3))) << "now that all have been read";
    }
  }
  const auto few = makeExactPlant(unlike(ObjectKind::Chain, 2), slanted(), 1e-3);
  std::vector<MassState> two(2);
  EXPECT_FALSE(dynamic_cast<const EndMasses*>(few.get())->observeEnds(two));
}

LinearSpace between(double lo, double hi) {
  LinearSpace where = slanted();
  where.domain = {lo, hi, false, constraints::AtEnd::Stop};
  return where;
}

// The hand draws the first mass ahead: it meets the end first, and all are put where they were at that moment.
TEST(LinearPlant, AtAnEndEveryMassIsWhereItWasWhenTheFirstCameThere) {
  for (const double side : {1.0, -1.0}) {
    const LinearSpace where = side > 0 ? between(-INFINITY, 0.5) : between(-0.5, INFINITY);
    ObjectModel model = unlike(ObjectKind::Chain, 3);
    model.gravity = {};
    const auto exact = makeExactPlant(model, where, 1e-3);
    const auto other = makeLinePlant(model, where, {"adaptive", 0});
    const HandSegment hand = heldSegment(where.origin + side * 2 * where.tangent);
    int ticks[2] = {0, 0}, k = 0;
    for (Plant* p : {exact.get(), other.get()}) {
      p->placeAtRest(std::array{0.0});
      EXPECT_EQ(p->stopReason(), "");
      StepStatus status = StepStatus::Ok;
      for (; status == StepStatus::Ok && ticks[k] < 1000; ++ticks[k]) status = p->step(hand, 1e-3);
      ++k;
      EXPECT_EQ(status, StepStatus::AtEnd);
      EXPECT_TRUE(holds(p->stopReason(), "a mass reached the end of the"));
      EXPECT_GT(p->lastStepFraction(), 0);
      EXPECT_LT(p->lastStepFraction(), 1);
      EXPECT_NEAR(observed(*p)[0].q[0], side * 0.5, 1e-12);
      EXPECT_LT(observed(*p)[2].q[0] * side, 0.5);
    }
    EXPECT_EQ(ticks[0], ticks[1]);
    EXPECT_NEAR(exact->lastStepFraction(), other->lastStepFraction(), 1e-6);
    expectSame(*exact, *other, startOf(hand), 1e-8);
  }
}

TEST(LinearPlant, ALineWithoutEndsOrWithAPeriodIsNeverLeft) {
  for (LinearSpace where : {slanted(), between(-0.1, 0.1)}) {
    where.domain.periodic = true;
    for (const char* method : {"exact", "adaptive"}) {
      ObjectModel model = unlike(ObjectKind::Point, 1);
      const auto plant = std::string(method) == "exact" ? makeExactPlant(model, where, 1e-3) : makeLinePlant(model, where, {method, 0});
      plant->setCoupled(false);
      plant->place(std::array{0.0}, std::array{3.0});
      EXPECT_EQ(run(*plant, noHand, 0.2), StepStatus::Ok);
      EXPECT_GT(std::abs(observed(*plant)[0].q[0]), 0.1);
    }
  }
}

// Between two elastic ends a mass goes to and fro, and nothing of its energy is lost.
TEST(LinearPlant, ElasticEndsThrowAMassBack) {
  for (const double rate : {7.3, -7.3}) {
    LinearSpace where = between(-0.25, 0.75);
    where.domain.atEnd = constraints::AtEnd::Bounce;
    ObjectModel model = unlike(ObjectKind::Point, 1);
    model.viscosity = 0, model.gravity = {};
    const auto plant = makeLinePlant(model, where, {"adaptive", 0});
    plant->setCoupled(false);
    plant->place(std::array{0.0}, std::array{rate});
    for (int tick = 1; tick <= 500; ++tick) {
      ASSERT_EQ(plant->step({}, 1e-3), StepStatus::Ok);
      const double way = std::fmod(100 + 0.25 + rate * tick * 1e-3, 2);  // from the lower end, there and back
      ASSERT_NEAR(observed(*plant)[0].q[0], (way < 1 ? way : 2 - way) - 0.25, 1e-11) << tick;
      ASSERT_NEAR(std::abs(observed(*plant)[0].qRate[0]), std::abs(rate), 1e-11) << tick;
    }
  }
}

// Ends five micrometres apart: more than a thousand right-hand sides of a tick's way to and fro.
TEST(LinearPlant, BetweenEndsThatAreTooNearTheStateStaysAsItWas) {
  LinearSpace where = between(-2e-5, 2e-5);
  where.domain.atEnd = constraints::AtEnd::Bounce;
  const auto plant = makeLinePlant(unlike(ObjectKind::Point, 1), where, {"adaptive", 0});
  plant->setCoupled(false);
  plant->place(std::array{1e-5}, std::array{3.0});
  const MassState before = observed(*plant)[0];
  const std::uint64_t none = plant->rhsEvaluations();
  EXPECT_EQ(plant->step({}, 1e-3), StepStatus::Capped);
  EXPECT_EQ(observed(*plant)[0].r, before.r);
  EXPECT_EQ(observed(*plant)[0].v, before.v);
  EXPECT_EQ(plant->lastStepFraction(), 1);
  EXPECT_GT(plant->rhsEvaluations() - none, 1000u);
  EXPECT_LT(plant->rhsEvaluations() - none, 1100u) << "each is counted once";
  EXPECT_EQ(plant->step({}, 1e-6), StepStatus::Ok) << "a shorter step is done";
}

}  // namespace
}  // namespace reachlab::dynamics
