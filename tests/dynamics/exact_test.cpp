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
  const Scene scene = compileScene(makePoint(m, {k, 0}));
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
  experiment::Experiment e = free(makeChain(3, 0.5, 400, {600, 5}));
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

}  // namespace
}  // namespace reachlab::dynamics
