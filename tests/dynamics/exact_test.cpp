#include <gtest/gtest.h>

#include "sim/dynamics/hand/hand_path.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/held_segment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

/// One mass at the end of a spring whose hand moves with constant velocity from rest at the mass: x - h = -(v/w) sin w t.
TEST(ExactPlant, AgreesWithTheClosedFormOfAMassPulledAtConstantSpeed) {
  const double k = 600, m = 2, speed = 0.1, w = std::sqrt(k / m);
  const Scene scene = compileScene(makeExperiment(experiment::ObjectKind::Point, {m}, {}, {k, 0}));
  scene.plant->placeAtRest(std::array{0.0});
  for (int i = 0; i < 1000; ++i) {
    const HandSegment hand = makeSegment(
        [&](double t) {
          return HandSample{{-0.1 + speed * t, 0, 0}, {speed, 0, 0}, true};
        },
        i * 1e-3, 1e-3);
    ASSERT_EQ(scene.plant->step(hand, 1e-3), StepStatus::Ok);
  }
  MassState mass;
  scene.plant->observe({}, {&mass, 1});
  const double tolerance = 1e-14;  // 1000 roundings of a place near 0.1 m
  EXPECT_NEAR(mass.r.x, -0.1 + speed - speed / w * std::sin(w), tolerance);
}

TEST(ExactPlant, TwoHalfStepsEqualOneWholeStepForAStiffDampedChain) {
  experiment::Experiment e = makeChain(5, 0.01, 1e8, {600, 5});
  e.object.damping.assign(4, 50);
  const Scene whole = compileScene(e), half = compileScene(e, {"", 5e-4, 0});
  for (const Scene* scene : {&whole, &half}) scene->plant->placeAtRest(std::array{0.0});
  std::vector<MassState> a(5), b(5);
  for (int i = 0; i < 1350; ++i) {
    ASSERT_EQ(whole.plant->step(makeSegment(reachAt, i * 1e-3, 1e-3), 1e-3), StepStatus::Ok);
    for (int j = 0; j < 2; ++j) ASSERT_EQ(half.plant->step(makeSegment(reachAt, i * 1e-3 + j * 5e-4, 5e-4), 5e-4), StepStatus::Ok);
    whole.plant->observe(reachAt((i + 1) * 1e-3), a);
    half.plant->observe(reachAt((i + 1) * 1e-3), b);
    for (int m = 0; m < 5; ++m) ASSERT_NEAR(a[m].r.x, b[m].r.x, 1e-13) << "promised for any stiffness, tick " << i << " mass " << m;
  }
}

// The same object twice: twenty equal masses go by modes; a mass that differs by its last bit in damping goes by the matrix.
TEST(ExactPlant, ModesAndMatrixAgree) {
  experiment::Experiment modal = makeChain(20, 0.15, 600), matrix = modal;
  matrix.object.damping.assign(19, 0.0);
  matrix.object.damping[3] = 1e-9;  // too little to see, enough to couple the modes
  const Scene a = compileScene(modal), b = compileScene(matrix);
  for (const Scene* scene : {&a, &b}) {
    scene->plant->placeAtRest(std::array{0.0});
    ASSERT_EQ(run(*scene->plant, reachAt, 1), StepStatus::Ok);
  }
  const auto ma = observed(*a.plant, reachAt(1)), mb = observed(*b.plant, reachAt(1));
  const double tolerance = 1e-11;  // [m] what that damper does in a second
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(ma[i].r.x, mb[i].r.x, tolerance);
}

// A hand that comes as samples is a polynomial of any degree up to a cubic. From 128 masses on free modes turn in a form of their own.
TEST(ExactPlant, ModesAndMatrixAgreeForAHandOfEveryDegree) {
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

// In space a hand pulls along all three axes at once, each another way. 1e-8 m is what RK4 errs by in half a second.
TEST(ExactPlant, EveryOtherMethodMovesAChainInSpaceAsItDoes) {
  experiment::Experiment e = makeChain(3, 0.5, 400, {600, 5});
  e.constraint.name = "free";
  e.object.damping.assign(2, 2);
  e.object.gravity = {1, -9.81, 0.5};
  const HandFunction hand = [](double t) {
    const MinimumJerk law = heldMinimumJerk(t / 0.8);
    return HandSample{law.value * Vec3{0.1, 0.06, -0.08}, law.rate / 0.8 * Vec3{0.1, 0.06, -0.08}, true};
  };
  const auto after = [&](const char* method) {
    const Scene scene = compileScene(e, {method, 1e-3, 0});
    scene.plant->placeAtRest(std::array{0.0, 0.0, 0.0});
    EXPECT_EQ(run(*scene.plant, hand, 0.5), StepStatus::Ok) << method;
    return observed(*scene.plant, hand(0.5));
  };
  const auto exact = after("exact");
  for (const char* method : {"rk4", "abm", "adaptive", "stiff"}) {
    const auto other = after(method);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_LT(norm(other[i].r - exact[i].r), 1e-8) << method << " mass " << i + 1;
      EXPECT_LT(norm(other[i].v - exact[i].v), 1e-6) << method << " mass " << i + 1;
      EXPECT_LT(norm(other[i].a - exact[i].a), 1e-4) << method << " mass " << i + 1;
    }
  }
}

TEST(ExactPlant, AnHourOfTheUndampedChainKeepsItsEnergy) {
  const Scene scene = compileScene(makeChain(5, 0.6, 600));
  scene.plant->place(std::array{0.0}, std::array{10.0});
  const HandSample hand{{-0.1, 0, 0}, {}, true};
  const double before = scene.plant->energy(hand);
  const HandSegment held = heldSegment(hand.position);
  for (int i = 0; i < 3600000; ++i) ASSERT_EQ(scene.plant->step(held, 1e-3), StepStatus::Ok);
  EXPECT_NEAR(scene.plant->energy(hand) / before, 1, 1e-9) << "3.6 million roundings of 1e-16";
}

TEST(ExactPlant, AChainThatNobodyHoldsKeepsItsMomentum) {
  experiment::Experiment e = makeChain(3, 0.5, 400);
  e.object.masses = {0.5, 2, 0.1};
  const Scene scene = freeScene(e, {1.0}, {2.0});
  const auto momentum = [&] {
    double sum = 0;
    const auto masses = observed(*scene.plant);
    for (int i = 0; i < 3; ++i) sum += e.object.masses[i] * masses[i].v.x;
    return sum;
  };
  scene.plant->setExtraForce({1, 0, 0});
  const double before = momentum();
  ASSERT_EQ(run(*scene.plant, noHand, 1), StepStatus::Ok);
  EXPECT_NEAR(momentum() - before, 1.0, 1e-13) << "1 N for 1 s";
}

TEST(ExactPlant, ObjectForceIsTheMassesAccelerations) {
  const Scene scene = compileScene(makeExperiment(experiment::ObjectKind::Parallel, {3, 3}, {50, 250}));
  scene.plant->placeAtRest(std::array{0.0});
  ASSERT_EQ(run(*scene.plant, reachAt, 0.7), StepStatus::Ok);
  const auto masses = observed(*scene.plant, reachAt(0.7));
  EXPECT_NEAR(scene.plant->couplingForce(reachAt(0.7)).x, 3 * masses[0].a.x + 3 * masses[1].a.x, 1e-13);
}

// With every damper that there is and a force from outside; the difference over two steps of 0.1 ms errs by their square.
TEST(ExactPlant, AccelerationsAreTheRatesOfTheVelocities) {
  experiment::Experiment e = makeChain(3, 0.6, 600, {600, 3});
  e.object.damping = {20, 50};
  e.object.viscosity = 0.5;
  constexpr double kStep = 1e-4;
  const Scene scene = compileScene(e, {"exact", kStep, 0});
  scene.plant->placeAtRest(std::array{0.0});
  scene.plant->setExtraForce({2, 0, 0});
  std::array<std::vector<MassState>, 3> at;
  int step = 0;
  for (auto& masses : at) {
    for (const int until = step == 0 ? 3000 : step + 1; step < until; ++step)
      ASSERT_EQ(scene.plant->step(makeSegment(reachAt, step * kStep, kStep), kStep), StepStatus::Ok);
    masses = observed(*scene.plant, reachAt(step * kStep));
  }
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(at[1][i].a.x, (at[2][i].v.x - at[0][i].v.x) / (2 * kStep), 1e-4) << "mass " << i + 1;
}

}  // namespace
}  // namespace reachlab::dynamics
