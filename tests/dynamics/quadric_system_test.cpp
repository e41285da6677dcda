#include "sim/dynamics/systems/quadric_system.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/dynamics/hand/hand_path.h"
#include "sim/dynamics/make_plant.h"

namespace reachlab::dynamics {
namespace {

constexpr double kRadius = 0.1;  // [m]
int evaluations = 0;

void evaluateSphere(const void*, const double*, double u, double v, constraints::SurfacePoint& p) noexcept {
  ++evaluations;
  const double su = std::sin(u), cu = std::cos(u), sv = std::sin(v), cv = std::cos(v);
  p.r = kRadius * Vec3{sv * cu, sv * su, cv};
  p.rU = kRadius * Vec3{-sv * su, sv * cu, 0};
  p.rV = kRadius * Vec3{cv * cu, cv * su, -sv};
}

constraints::Constraint countedSphere() {
  constraints::Constraint c;
  c.surface.function = evaluateSphere;
  c.domain[0] = {0, 2 * std::numbers::pi, true};
  c.domain[1] = {0, std::numbers::pi, false};
  return c;
}

ObjectModel beadModel() {
  ObjectModel model;
  model.mass = {1};
  model.handStiffness = {600};
  model.handDamping = {0};
  return model;
}

// On a sphere the state is a place, from which the formula's parameters are searched: a few evaluations, many times what a step costs.
TEST(QuadricSystem, OnlyWhoObservesPaysForTheSearchOfParameters) {
  const constraints::Constraint on = countedSphere();
  const ObjectModel model = beadModel();
  const QuadricSystem system(model, on, *fitQuadric(on.surface, on.domain, {0.4, 1}));
  const std::unique_ptr<Plant> plant = makePlant<SystemPlant<QuadricSystem>>(model, system, {"auto", 0});
  const std::array start{0.4, 1.0};
  plant->placeAtRest(start);
  HandPath path;
  HandSample hand{constraints::evaluate(on.surface, start[0], start[1]).r, {}, true};
  for (int tick = 0; tick < 100; ++tick) {
    hand.position.z += 1e-4;
    path.push(hand);
    evaluations = 0;
    ASSERT_EQ(plant->step(path.segment(true), 1e-3), StepStatus::Ok);
    const Vec3 force = plant->couplingForce(hand);
    const double energy = plant->energy(hand);
    EXPECT_EQ(evaluations, 0) << tick;

    MassState mass;
    plant->observe(hand, {&mass, 1});
    EXPECT_GT(evaluations, 0) << tick;
    EXPECT_LT(norm(constraints::evaluate(on.surface, mass.q[0], mass.q[1]).r - mass.r), 1e-14);
    EXPECT_LT(norm(force - 600 * (hand.position - mass.r)), 1e-12);
    EXPECT_NEAR(energy, 0.5 * dot(mass.v, mass.v) + 0.5 * dot(force, force) / 600, 1e-12);
  }
}

}  // namespace
}  // namespace reachlab::dynamics
