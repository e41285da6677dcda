#include "sim/dynamics/object/object_model.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/dynamics/object/forces.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

using experiment::ObjectKind;

std::string refusalOfObject(const experiment::Experiment& e) {
  return refusalOf([&] { (void)makeObjectModel(e); });
}

TEST(ObjectModel, AChainHangsOnItsFirstMassAndAParallelObjectOnAll) {
  experiment::Experiment chain = makeExperiment(ObjectKind::Chain, {1, 2, 3}, {40, 50}, {600, 7});
  chain.object.damping = {4};
  chain.object.viscosity = 0.3;
  chain.object.gravity = {1, 2, 3};
  const ObjectModel model = makeObjectModel(chain);
  EXPECT_EQ(model.kind, ObjectKind::Chain);
  EXPECT_EQ(model.count(), 3);
  EXPECT_EQ(model.mass, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(model.stiffness, (std::vector<double>{40, 50}));
  EXPECT_EQ(model.damping, (std::vector<double>{4, 0})) << "none where none is given";
  EXPECT_EQ(model.handStiffness, (std::vector<double>{600, 0, 0}));
  EXPECT_EQ(model.handDamping, (std::vector<double>{7, 0, 0}));
  EXPECT_EQ(model.viscosity, 0.3);
  EXPECT_EQ(model.gravity, (Vec3{1, 2, 3}));

  experiment::Experiment parallel = makeExperiment(ObjectKind::Parallel, {1, 2}, {40, 50});
  parallel.object.damping = {4, 5};
  const ObjectModel side = makeObjectModel(parallel);
  EXPECT_EQ(side.handStiffness, (std::vector<double>{40, 50}));
  EXPECT_EQ(side.handDamping, (std::vector<double>{4, 5}));
  EXPECT_TRUE(side.stiffness.empty() && side.damping.empty());
}

TEST(ObjectModel, OfSeveralHandsASpringIsTheSum) {
  experiment::Experiment e = makeExperiment(ObjectKind::Chain, {1, 2, 3}, {40, 50}, {600, 7});
  e.hands = {{1, {100}, {1}, {}}, {3, {200}, {2}, {}}, {0, {10, 20, 30}, {0.1, 0.2, 0.3}, {}}};
  const ObjectModel model = makeObjectModel(e);
  EXPECT_EQ(model.handStiffness, (std::vector<double>{110, 20, 230}));
  EXPECT_EQ(model.handDamping, (std::vector<double>{1.1, 0.2, 2.3}));
  e.hands[1].stiffness = {-1};
  EXPECT_TRUE(holds(refusalOfObject(e), "the hand's stiffness of spring 3 is -1"));
  e.hands[1] = {3, {1}, {-2}, {}};
  EXPECT_TRUE(holds(refusalOfObject(e), "the hand's damping of spring 3 is -2"));
}

TEST(ObjectModel, WhatNoMethodCanIntegrateIsRefusedByItsNameAndPlace) {
  const experiment::Experiment good = makeExperiment(ObjectKind::Chain, {1, 2}, {40}, {600, 7});
  const double none = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
  struct Case {
    std::function<void(experiment::Experiment&)> spoil;
    const char* words;
  };
  for (const Case& c : {Case{[](auto& e) { e.object.masses.clear(); }, "the object has no mass: give masses_kg"},
                        Case{[](auto& e) { e.object.masses[1] = 0; }, "the mass of mass 2 is 0.000000: a mass must be positive"},
                        Case{[](auto& e) { e.object.masses[0] = -1; }, "the mass of mass 1 is -1.000000: a mass must be positive"},
                        Case{[&](auto& e) { e.object.masses[0] = none; }, "the mass of mass 1 is nan"},
                        Case{[](auto& e) { e.object.stiffness = {-3}; }, "the stiffness of spring 1 is -3.000000: must be 0 or more"},
                        Case{[](auto& e) { e.object.damping = {-2}; }, "the damping of spring 1 is -2.000000: must be 0 or more"},
                        Case{[&](auto& e) { e.coupling->stiffness = endless; }, "the coupling of spring 1 is inf"},
                        Case{[](auto& e) { e.coupling->damping = -1; }, "the coupling of spring 2 is -1"},
                        Case{[](auto& e) { e.object.viscosity = -1; }, "the viscosity of spring 1 is -1"},
                        Case{[&](auto& e) { e.object.gravity.z = none; }, "gravity_m_per_s2 is not finite"},
                        Case{[](auto& e) {
                               e.object.stiffness = {40, 50};
                             },
                             "stiffness_n_per_m has 2 numbers where 1 are needed"}}) {
    experiment::Experiment e = good;
    c.spoil(e);
    EXPECT_TRUE(holds(refusalOfObject(e), c.words)) << c.words;
  }
  EXPECT_EQ(refusalOfObject(good), "");
  EXPECT_EQ(refusalOfObject(makeExperiment(ObjectKind::Chain, {1, 2}, {0}, {0, 0})), "") << "no spring at all is allowed";
  EXPECT_TRUE(holds(refusalOfObject(makeExperiment(ObjectKind::Parallel, {1, 2}, {40})), "has 1 numbers where 2 are needed"));
}

TEST(ObjectModel, FiveHundredAndTwelveMassesAreTheMost) {
  EXPECT_EQ(refusalOfObject(makeChain(512, 0.1, 600)), "");
  EXPECT_EQ(refusalOfObject(makeChain(513, 0.1, 600)), "more than 512 masses");
}

// Of the hand 100 and 2, of the neighbours 30, 50 and 4, 6, of the medium 1: Gershgorin's disc of each mass in turn decides.
TEST(ObjectModel, TheBoundOnTheFastestModeIsOfTheMassWhoseSpringsAreStiffestForIt) {
  ObjectModel model;
  model.kind = ObjectKind::Chain;
  model.stiffness = {30, 50};
  model.damping = {4, 6};
  model.handStiffness = {100, 0, 0};
  model.handDamping = {2, 0, 0};
  model.viscosity = 1;
  const std::array stiffness{160.0, 160.0, 100.0}, damping{11.0, 21.0, 13.0};
  for (std::size_t light = 0; light < 3; ++light)
    for (const double mass : {1e-3, 40.0}) {
      model.mass.assign(3, 1e9);
      model.mass[light] = mass;
      EXPECT_NEAR(boundFastestMode(model), std::max(std::sqrt(stiffness[light] / mass), damping[light] / mass),
                  1e-12 * damping[light] / mass)
          << light;
    }
  model.stiffness.clear(), model.damping.clear();
  model.mass = {1, 1, 1};
  model.handStiffness = {4, 9, 16};
  EXPECT_EQ(boundFastestMode(model), 4) << "parallel masses have no neighbours";
}

/// Three masses with nothing equal and nothing zero.
struct Around {
  ObjectModel model;
  Surroundings around;
  std::vector<MassState> masses;
  Around() : masses(3) {
    model.kind = ObjectKind::Chain;
    model.mass = {1.5, 2, 0.5};
    model.stiffness = {30, 50}, model.damping = {4, 6};
    model.handStiffness = {100, 20, 7}, model.handDamping = {2, 3, 5};
    model.viscosity = 0.7;
    model.gravity = {0.3, -9.81, 1.1};
    around = {{{0.3, -0.2, 0.1}, {0.5, 0.4, -0.3}, true}, true, {1.3, -0.6, 0.9}};
    for (int i = 0; i < 3; ++i) {
      masses[i].r = {0.1 + 0.2 * i, 0.3 - 0.1 * i * i, 0.05 * i};
      masses[i].v = {0.4 * i - 0.3, 0.2 + 0.1 * i, 0.6 - 0.5 * i};
    }
  }
  Vec3 force(int i) const { return netForce(model, around, masses, i); }
  double energy() const { return computeEnergy(model, around, masses); }
};

// Whatever is not a damper nor the extra force on mass 1 has a potential.
TEST(Forces, WithoutDampersAreWhatTheEnergyFallsBy) {
  for (const bool coupled : {true, false}) {
    Around at;
    at.around.coupled = coupled;
    at.model.viscosity = 0;
    at.model.damping = {0, 0}, at.model.handDamping = {0, 0, 0};
    constexpr double kBy = 1e-3;  // [m]; the energy is of second degree, so that a difference is exact
    for (int i = 0; i < 3; ++i)
      for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        Around up = at, down = at;
        up.masses[i].r.*axis += kBy, down.masses[i].r.*axis -= kBy;
        const double slope = (up.energy() - down.energy()) / (2 * kBy);
        EXPECT_NEAR(at.force(i).*axis - (i == 0 ? at.around.extraForce.*axis : 0), -slope, 1e-9) << i;
      }
  }
}

TEST(Forces, OfDampersGoByTheDifferencesOfTheVelocities) {
  const Around at;
  Around still = at;
  for (MassState& mass : still.masses) mass.v = {};
  still.around.hand.velocity = {};
  const Vec3 hand = at.around.hand.velocity, v0 = at.masses[0].v, v1 = at.masses[1].v, v2 = at.masses[2].v;
  EXPECT_LT(norm(at.force(0) - still.force(0) - (2 * (hand - v0) + 4 * (v1 - v0) - 0.7 * v0)), 1e-13);
  EXPECT_LT(norm(at.force(1) - still.force(1) - (3 * (hand - v1) + 4 * (v0 - v1) + 6 * (v2 - v1) - 0.7 * v1)), 1e-13);
  EXPECT_LT(norm(at.force(2) - still.force(2) - (5 * (hand - v2) + 6 * (v1 - v2) - 0.7 * v2)), 1e-13);
}

TEST(Forces, TheEnergyOfMotionIsHalfTheMassesTimesTheSquares) {
  const Around at;
  Around still = at;
  for (MassState& mass : still.masses) mass.v = {};
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += at.model.mass[i] * dot(at.masses[i].v, at.masses[i].v) / 2;
  EXPECT_NEAR(at.energy() - still.energy(), sum, 1e-13);
}

}  // namespace
}  // namespace reachlab::dynamics
