#include <gtest/gtest.h>

#include <cmath>

#include "sim/dynamics/hand_function.h"
#include "sim/dynamics/hand_path.h"
#include "sim/dynamics/plant.h"

namespace reachlab {
namespace {

Experiment chain(int n, double mass, double stiffness, double damping, Coupling coupling) {
  Experiment e;
  e.object.kind = ObjectKind::Chain;
  e.object.masses.assign(n, mass);
  e.object.stiffness.assign(n - 1, stiffness);
  e.object.damping.assign(n - 1, damping);
  e.coupling = coupling;
  e.task = Task{};
  e.task->start = {0};
  e.task->target = {6.283185307179586};
  return e;
}

HandSample reachAt(double t) {
  const MinJerk law = minJerk(t / 1.35);
  return {{-0.1 + 0.2 * law.s, 0, 0}, {0.2 * law.rate / 1.35, 0, 0}, true};
}

/// One mass at the end of a spring whose hand moves with constant velocity from rest at the mass: x - h = -(v/w) sin w t.
TEST(ExactPlant, AgreesWithTheClosedFormOfAMassPulledAtConstantSpeed) {
  const double k = 600, m = 2, speed = 0.1, w = std::sqrt(k / m);
  Experiment e = chain(1, m, 0, 0, {k, 0});
  e.object.kind = ObjectKind::Point;
  const Scene scene = compileScene(e);
  for (int i = 0; i < 1000; ++i) {
    const HandSegment hand = makeSegment([&](double t) { return HandSample{{-0.1 + speed * t, 0, 0}, {speed, 0, 0}, true}; }, i * 1e-3, 1e-3);
    ASSERT_EQ(scene.plant->step(hand, 1e-3), StepStatus::Ok);
  }
  MassState mass;
  scene.plant->observe({}, {&mass, 1});
  const double tolerance = 1e-14;  // 1000 roundings of a place near 0.1 m
  EXPECT_NEAR(mass.r.x, -0.1 + speed - speed / w * std::sin(w), tolerance);
}

TEST(ExactPlant, TwoHalfStepsEqualOneWholeStepForAStiffDampedChain) {
  const Experiment e = chain(5, 0.01, 1e8, 50, {600, 5});
  const Scene whole = compileScene(e), half = compileScene(e, {"", 5e-4, 0});
  std::vector<MassState> a(5), b(5);
  for (int i = 0; i < 1350; ++i) {
    ASSERT_EQ(whole.plant->step(makeSegment(reachAt, i * 1e-3, 1e-3), 1e-3), StepStatus::Ok);
    for (int j = 0; j < 2; ++j) ASSERT_EQ(half.plant->step(makeSegment(reachAt, i * 1e-3 + j * 5e-4, 5e-4), 5e-4), StepStatus::Ok);
    whole.plant->observe(reachAt((i + 1) * 1e-3), a);
    half.plant->observe(reachAt((i + 1) * 1e-3), b);
    for (int m = 0; m < 5; ++m) ASSERT_NEAR(a[m].r.x, b[m].r.x, 1e-13) << "promised for any stiffness, tick " << i << " mass " << m;
  }
}

TEST(ExactPlant, ModesAndMatrixAgree) {
  Experiment e = chain(20, 0.15, 600, 0, {600, 0});
  const Scene modal = compileScene(e);
  e.object.damping[0] = 1e-300;  // not proportional in form, nothing in effect: but small enough to stay modal
  std::vector<MassState> a(20), b(20);
  e.object.damping.assign(19, 0.3);  // b = k / 2000: proportional but for the hand's spring
  const Scene damped = compileScene(e), halved = compileScene(e, {"", 5e-4, 0});
  for (int i = 0; i < 500; ++i) {
    ASSERT_EQ(damped.plant->step(makeSegment(reachAt, i * 1e-3, 1e-3), 1e-3), StepStatus::Ok);
    for (int j = 0; j < 2; ++j) ASSERT_EQ(halved.plant->step(makeSegment(reachAt, i * 1e-3 + j * 5e-4, 5e-4), 5e-4), StepStatus::Ok);
  }
  damped.plant->observe(reachAt(0.5), a);
  halved.plant->observe(reachAt(0.5), b);
  for (int m = 0; m < 20; ++m) EXPECT_NEAR(a[m].r.x, b[m].r.x, 1e-13);
}

}  // namespace
}  // namespace reachlab
