#include "devices/virtual/virtual_device.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/fault.h"
#include "devices/make_device.h"
#include "devices/virtual/loop_stability.h"
#include "devices/virtual/stability_map.h"
#include "sim/haptics/run_conductor.h"

namespace reachlab::devices {
namespace {

// A hand that means to stay where it is.
class StillHand final : public haptics::HapticDevice {
 public:
  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info;
    info.virtualHand = true;
    return info;
  }
  haptics::DeviceSample read() noexcept override { return {}; }
  void write(const Vec3&) noexcept override {}
};

DeviceModel frictionless() {
  DeviceModel model = *findDeviceModel("premium15");
  model.friction = 0;
  return model;
}

TEST(VirtualDevice, AHeldHandleGivesWayToAForceAsItsStiffnessSays) {
  VirtualDevice device(frictionless(), {.hand = {1, 300, 30}, .quantised = false}, std::make_unique<StillHand>());
  for (int i = 0; i < 5000; ++i) {
    device.write({3, 0, 0});
    device.read();
  }
  EXPECT_NEAR(device.truePlace().x, 3.0 / 300, 1e-9) << "F/k at rest";
}

TEST(VirtualDevice, TellsTheMassAndTheFrictionThatItMovesWith) {
  DeviceModel model = *findDeviceModel("premium15");
  model.mass = 0.11, model.friction = 0.12, model.viscosity = 0.13;
  const haptics::DeviceInfo info = VirtualDevice(model, {}, std::make_unique<StillHand>()).info();
  EXPECT_EQ(info.apparentMass, 0.11);
  EXPECT_EQ(info.coulombFriction, 0.12);
  EXPECT_EQ(info.viscosity, 0.13);
}

TEST(VirtualDevice, AFreeHandleGainsTheForcesImpulse) {
  VirtualDevice device(frictionless(), {.hand = {0, 0, 0}, .quantised = false}, std::make_unique<StillHand>());
  device.read();
  for (int i = 0; i < 100; ++i) {
    device.write({0.1, 0, 0});
    device.read();
  }
  // a t^2/2 with a = 0.1/0.075; semi-implicit Euler at 0.1 ms is ahead by half a step: 0.1 %.
  EXPECT_NEAR(device.truePlace().x, 0.5 * 0.1 / 0.075 * 0.01, 1.5e-3 * 0.5 * 0.1 / 0.075 * 0.01);
}

TEST(VirtualDevice, NoForceBeyondItsPeakIsFelt) {
  VirtualDevice device(frictionless(), {.hand = {1, 300, 30}, .quantised = false}, std::make_unique<StillHand>());
  for (int i = 0; i < 5000; ++i) {
    device.write({0, 100, 0});
    device.read();
  }
  EXPECT_NEAR(device.truePlace().y, 8.5 / 300, 1e-9);
}

TEST(VirtualDevice, CoulombFrictionHoldsASmallForce) {
  VirtualDevice device(*findDeviceModel("omni"), {.hand = {0, 0, 0}, .quantised = false}, std::make_unique<StillHand>());
  for (int i = 0; i < 1000; ++i) {
    device.write({0.1, 0, 0});
    device.read();
  }
  EXPECT_LT(device.truePlace().x, 1e-3) << "0.1 N against 0.26 N of friction: it creeps at less than 1 mm/s";
}

TEST(VirtualDevice, ThePlaceComesInStepsOfItsResolution) {
  const DeviceModel& model = *findDeviceModel("omni");
  VirtualDevice device(model, {}, std::make_unique<StillHand>());
  for (int i = 0; i < 500; ++i) {
    device.write({0, 0, 2});
    const double steps = device.read().position.z / model.resolution;
    ASSERT_NEAR(steps, std::round(steps), 1e-9);
  }
}

TEST(VirtualDevice, ADelayedForceActsThatManyTicksLater) {
  VirtualDevice prompt(frictionless(), {.hand = {1, 0, 0}, .quantised = false}, std::make_unique<StillHand>());
  VirtualDevice late(frictionless(), {.hand = {1, 0, 0}, .delayTicks = 5, .quantised = false}, std::make_unique<StillHand>());
  prompt.read(), late.read();
  std::vector<double> first, second;
  for (int i = 0; i < 100; ++i) {
    for (auto* device : {&prompt, &late}) {
      device->write({i < 10 ? 1.0 : 0.0, 0, 0});
      device->read();
      (device == &prompt ? first : second).push_back(device->truePlace().x);
    }
  }
  for (std::size_t i = 10; i < 100; ++i) EXPECT_NEAR(second[i], first[i - 5], 1e-12);
}

TEST(VirtualDevice, AWholeRunIsTheSameTwiceAndWithinTheDevicesForce) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  const auto run = [&] {
    haptics::LoopOptions options;
    options.virtualClock = true;
    haptics::RunConductor conductor(experiment, makeDevice("virtual:premium15", experiment, 3), {trial::PlannedTrial{0}}, options);
    conductor.start(nullptr);
    return conductor.runTrial(std::atomic<bool>{false})->result;
  };
  const trial::TrialResult one = run(), two = run();
  EXPECT_EQ(one.movementTime, two.movementTime);
  EXPECT_EQ(one.by, two.by);
  EXPECT_NE(one.outcome, trial::Outcome::Aborted) << nameOf(one.reason);
}

TEST(VirtualDevice, ItsOptionsAreChecked) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  EXPECT_THROW(makeDevice("virtual", experiment, 1), FaultError);
  EXPECT_THROW(makeDevice("virtual:falcon", experiment, 1), FaultError);
  EXPECT_THROW(makeDevice("virtual:omni,arm-mass=-1", experiment, 1), FaultError);
  EXPECT_THROW(makeDevice("virtual:omni,colour=red", experiment, 1), FaultError);
  EXPECT_NO_THROW(makeDevice("virtual:omni,arm-mass=2,noise=0", experiment, 1));
}

LoopSettings passiveArm(int delay) {
  LoopSettings s;
  s.mass = 0.1;
  s.friction = 0.5;
  s.delayTicks = delay;
  s.estimator.kind = "difference";
  return s;
}

// b > k T/2 without delay, 3 k T/2 with one tick, 5 k T/2 with two (Colgate and Schenkel): 1000, 333, 200 N/m for 0.5 N s/m. The light
// body comes within 1 % of the law.
TEST(LoopStability, TheLargestStableStiffnessIsColgatesForALightBody) {
  EXPECT_NEAR(largestStableStiffness(passiveArm(0)), 1000, 10);
  EXPECT_NEAR(largestStableStiffness(passiveArm(1)), 333, 3.3);
  EXPECT_NEAR(largestStableStiffness(passiveArm(2)), 200, 2);
}

TEST(LoopStability, WhatItCallsStableDiesOutInTheSimulatedDeviceAndTheRestGrows) {
  for (const double share : {0.8, 1.3}) {  // the simulated body's Euler steps of 0.1 ms shift the limit by some 10 %
    DeviceModel model = frictionless();
    model.mass = 0.1;
    model.viscosity = 0.5;
    model.maxForce = 1e12;  // the linear loop: nothing is clamped
    VirtualDevice device(model, {.hand = {0, 0, 0}, .quantised = false}, std::make_unique<StillHand>());
    const double stiffness = share * largestStableStiffness(passiveArm(0));
    Vec3 place = device.read().position;
    double early = 0, late = 0;
    for (int i = 0; i < 4000; ++i) {
      device.write(Vec3{-stiffness * place.x + (i < 5 ? 0.1 : 0.0), 0, 0});
      place = device.read().position;
      double& most = i < 2000 ? early : late;
      if (i > 200) most = std::max(most, std::abs(place.x));
    }
    if (share < 1) EXPECT_LT(late, early);
    else EXPECT_GT(late, early);
  }
}

TEST(LoopStability, ThePapersCouplingIsStableOnAHeldPremium) {
  LoopSettings s;
  const DeviceModel& premium = *findDeviceModel("premium15");
  s.mass = premium.mass + 0.3;
  s.friction = premium.viscosity + 3;  // a hand adds 1 to 10 N s/m
  for (const double stiffness : {500.0, 600.0, 800.0}) {
    s.stiffness = stiffness;
    EXPECT_TRUE(isStable(s)) << stiffness;
    EXPECT_GT(passivityMargin(s), 0);
  }
  s.friction = 0.2;
  s.stiffness = 600;
  EXPECT_LT(passivityMargin(s), 0) << "let go, 600 N/m is not passive: 0.3 N s/m are needed";
}

// "Realistic … sensations are achieved when stiffness coefficients k_h exceed 500 N/m", and the paper's experiments have 600 N/m without damping.
TEST(StabilityMap, ThePapersStiffnessIsAmongTheStableOnesOnEachPremium) {
  for (const char* name : {"premium15", "premium60", "highforce"}) {
    const auto map = computeStabilityMap(*findDeviceModel(name), {});
    ASSERT_FALSE(map.empty());
    for (const StabilityPoint& p : map) EXPECT_GE(p.largestStable, 600) << name << ", hand " << p.handDamping << ", b_h " << p.damping;
    EXPECT_GE(map.front().largestPassive, 600) << name << ": without coupling damping it is passive even in the lightest of the hands";
  }
}

}  // namespace
}  // namespace reachlab::devices
