#include "devices/virtual/virtual_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/fault.h"
#include "devices/driver/registry.h"
#include "devices/make_device.h"
#include "devices/virtual/loop_stability.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/run_conductor.h"
#include "tests/devices/driver_answers.h"
#include "tests/haptics/set_device.h"

namespace reachlab::devices {
namespace {

using SetHand = haptics::test::SetDevice;  // means to stay where it is

DeviceModel frictionless() {
  DeviceModel model = *findDeviceModel("premium15");
  model.friction = 0;
  return model;
}

TEST(VirtualDevice, TellsTheMassAndTheFrictionThatItMovesWith) {
  DeviceModel model = *findDeviceModel("premium15");
  model.mass = 0.11, model.friction = 0.12, model.viscosity = 0.13;
  const haptics::DeviceInfo info = VirtualDevice(model, {}, std::make_unique<SetHand>()).info();
  EXPECT_EQ(info.apparentMass, 0.11);
  EXPECT_EQ(info.coulombFriction, 0.12);
  EXPECT_EQ(info.viscosity, 0.13);
}

TEST(VirtualDevice, ADelayedForceActsThatManyTicksLater) {
  VirtualDevice prompt(frictionless(), {.hand = {1, 0, 0}, .quantised = false}, std::make_unique<SetHand>());
  VirtualDevice late(frictionless(), {.hand = {1, 0, 0}, .delayTicks = 5, .quantised = false}, std::make_unique<SetHand>());
  prompt.read(), late.read();
  std::vector<double> first, second;
  for (int i = 0; i < 100; ++i) {
    for (auto* device : {&prompt, &late}) {
      device->write({i < 10 ? 1.0 : 0.0, 0, 0});
      (device == &prompt ? first : second).push_back(device->read().position.x);
    }
  }
  for (std::size_t i = 10; i < 100; ++i) EXPECT_NEAR(second[i], first[i - 5], 1e-12);
}

TEST(VirtualDevice, AWholeRunIsTheSameTwiceAndWithinTheDevicesForce) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  const auto run = [&] {
    haptics::RunConductor conductor(experiment::CompiledExperiment(experiment), makeDevice("virtual:premium15", experiment, 3),
                                    {trial::PlannedTrial{0}}, {.virtualClock = true, .clock = {}});
    conductor.start(nullptr);
    return conductor.runTrial(std::atomic<bool>{false})->result;
  };
  const trial::TrialResult one = run(), two = run();
  EXPECT_EQ(one.movementTime, two.movementTime);
  EXPECT_EQ(one.by, two.by);
  EXPECT_NE(one.outcome, trial::Outcome::Aborted) << nameOf(one.reason);
}

class VirtualDevices : public ::testing::Test, public DriverAnswers {};

TEST_F(VirtualDevices, AreMadeByOptionsThatAreChecked) {
  for (const char* bad : {"virtual", "virtual:falcon", "virtual:omni,arm-mass=-1", "virtual:omni,colour=red"})
    EXPECT_THROW(make(bad), FaultError) << bad;
  EXPECT_NO_THROW(make("virtual:omni,arm-mass=2,noise=0"));
}

LoopSettings passiveArm(int delay) { return {.mass = 0.1, .friction = 0.5, .delayTicks = delay, .estimator = {.kind = "difference"}}; }

// b > k T/2 without delay, 3 k T/2 with one tick, 5 k T/2 with two (Colgate and Schenkel): 1000, 333, 200 N/m for 0.5 N s/m. The light
// body comes within 1 % of the law.
TEST(LoopStability, TheLargestStableStiffnessIsColgatesForALightBody) {
  EXPECT_NEAR(largestStableStiffness(passiveArm(0)), 1000, 10);
  EXPECT_NEAR(largestStableStiffness(passiveArm(1)), 333, 3.3);
  EXPECT_NEAR(largestStableStiffness(passiveArm(2)), 200, 2);
  for (const int delay : {0, 1, 2}) {
    for (const StabilityPoint& p : computeStabilityMap(*findDeviceModel("premium15"), {.delayTicks = delay, .estimator = {}}))
      EXPECT_LE(p.largestPassive, 1.01 * p.largestStable) << "what is passive is stable, " << delay;
  }
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

Vec3 lawAt(int tick) {
  const double t = 1e-3 * tick;
  return {0.02 + 0.1 * t * t, -0.03 * (1 - std::cos(3 * t)), 0.04 * (1 - std::cos(5 * t))};
}

// A hand whose place at each tick is that of `lawAt`.
std::unique_ptr<SetHand> movingHand() {
  auto hand = std::make_unique<SetHand>();
  hand->about.virtualHand = true;
  hand->sample.buttons = 9;
  hand->whileItIsRead = [&sample = hand->sample, &reads = hand->reads] {
    sample.position = lawAt(reads - 1);
    sample.valid = reads != 100;
  };
  return hand;
}

// Its own inertia and the damper's target are fed forward: without force and friction it is where the hand means to be.
TEST(VirtualDevice, WithoutAForceItGoesWhereTheHandMeansTo) {
  VirtualDevice device(frictionless(), {.hand = {1, 300, 10}, .quantised = false}, movingHand());
  for (int tick = 0; tick < 1000; ++tick) {
    const haptics::DeviceSample sample = device.read();
    // The acceleration, some 1 m/s^2, comes half a tick late to a mass of 1 kg on a spring of 300 N/m.
    ASSERT_LT(norm(sample.position - lawAt(tick)), 6e-5) << tick;
    ASSERT_EQ(sample.reports, static_cast<std::uint64_t>(tick + 1));
    ASSERT_EQ(sample.buttons, 9u);
    ASSERT_EQ(sample.valid, tick != 99);
  }
}

TEST(VirtualDevice, PlacedItIsWhereTheHandIsAndForgetsItsForces) {
  auto owned = movingHand();
  SetHand* const hand = owned.get();
  VirtualDevice device(frictionless(), {.hand = {1, 300, 10}, .delayTicks = 3, .quantised = false}, std::move(owned));
  device.prepareTrial(4);
  EXPECT_EQ(hand->prepared, std::vector{4});
  for (int i = 0; i < 200; ++i) device.write({3, 3, 3}), device.read();
  device.cue(haptics::Cue::Go);
  device.write({3, 3, 3});
  EXPECT_GT(norm(device.read().position - lawAt(200)), 1e-3) << "a go changes nothing";
  device.cue(haptics::Cue::Place);
  EXPECT_EQ(hand->cues.size(), 2u);
  hand->reads = 0;
  for (int tick = 0; tick < 30; ++tick) ASSERT_LT(norm(device.read().position - lawAt(tick)), 2e-5) << tick;
}

// m x'' = F - b x' between the ticks, on each axis for itself: x = F/b (t - m/b (1 - e^{-bt/m})).
TEST(VirtualDevice, ViscousFrictionDragsOnEveryAxis) {
  DeviceModel model = frictionless();
  model.mass = 0.2, model.viscosity = 1.5;
  VirtualDevice device(model, {.hand = {0.1, 0, 0}, .quantised = false}, std::make_unique<SetHand>());
  device.read();
  const Vec3 force{0.3, -0.2, 0.1};
  for (int tick = 1; tick <= 500; ++tick) {
    device.write(force);
    const double t = 1e-3 * tick, rate = 1.5 / 0.3;
    ASSERT_LT(norm(device.read().position - (t - (1 - std::exp(-rate * t)) / rate) / 1.5 * force), 4e-5) << tick;
  }
}

// c tanh(v/v0) with v0 = 1 mm/s: a force below c creeps at v0 artanh(F/c).
TEST(VirtualDevice, BelowItsFrictionItCreeps) {
  DeviceModel model = frictionless();
  model.friction = 0.4;
  VirtualDevice device(model, {.hand = {0, 0, 0}, .quantised = false}, std::make_unique<SetHand>());
  Vec3 before, place;
  for (int i = 0; i < 400; ++i) {
    before = place;
    device.write({0.1, -0.2, 0.3});
    place = device.read().position;
  }
  const Vec3 speed = (place - before) / 1e-3;
  EXPECT_NEAR(speed.x, 1e-3 * std::atanh(0.25), 1e-8);
  EXPECT_NEAR(speed.y, -1e-3 * std::atanh(0.5), 1e-8);
  EXPECT_NEAR(speed.z, 1e-3 * std::atanh(0.75), 1e-8);
}

TEST(VirtualDevice, AForceThatIsNoNumberIsNoneAndABoundedOneKeepsItsDirection) {
  VirtualDevice device(frictionless(), {.hand = {1, 300, 30}, .quantised = false}, std::make_unique<SetHand>());
  Vec3 place;
  for (int i = 0; i < 4000; ++i) device.write({30, -40, 0}), place = device.read().position;
  EXPECT_LT(norm(place - 8.5 / 300 * Vec3{0.6, -0.8, 0}), 1e-9);
  for (int i = 0; i < 4000; ++i) device.write({NAN, 1, 1}), place = device.read().position;
  EXPECT_LT(norm(place), 1e-9);
}

TEST(VirtualDevice, ThePlaceOfEachAxisIsRounded) {
  DeviceModel model = frictionless();
  model.resolution = 1e-3;
  VirtualDevice device(model, {.hand = {1, 300, 10}}, movingHand());
  VirtualDevice exact(model, {.hand = {1, 300, 10}, .quantised = false}, movingHand());
  for (int tick = 0; tick < 500; ++tick) {
    const Vec3 told = device.read().position, is = exact.read().position;
    for (const auto& [a, b] : {std::pair{told.x, is.x}, {told.y, is.y}, {told.z, is.z}}) {
      ASSERT_NEAR(a, 1e-3 * std::round(b / 1e-3), 1e-15) << tick;
    }
  }
  EXPECT_EQ(device.info().resolution, 1e-3);
}

// One tick of the loop by hand: its state carried on by the matrix exponential of a free body, v' = -b/m v + F/m, against the eigenvalue's
// law that the largest of them is how fast the motion grows.
TEST(LoopStability, TheRadiusIsHowFastTheMotionGrowsOrDies) {
  for (const bool filtered : {false, true})
    for (const int delay : {0, 1, 3}) {
      LoopSettings s;
      s.stiffness = 900, s.damping = 2, s.mass = 0.35, s.friction = 1.7, s.handStiffness = 40, s.delayTicks = delay;
      s.period = 1.5e-3;
      s.estimator.kind = filtered ? "butterworth" : "difference";
      s.estimator.cutoff = 30;
      // Between ticks by 400 steps of the midpoint rule; the filter by its own recursion from the bilinear transform.
      const double wc = std::tan(std::numbers::pi * 30 * s.period), q = std::numbers::sqrt2 * wc, norm0 = 1 + q + wc * wc;
      const double b0 = wc * wc / norm0, a1 = 2 * (wc * wc - 1) / norm0, a2 = (1 - q + wc * wc) / norm0;
      double x = 1e-3, v = 0, old = 1e-3, in1 = 0, in2 = 0, out1 = 0, out2 = 0;
      std::vector<double> waiting(static_cast<std::size_t>(delay), 0);
      const auto energy = [&] { return std::hypot(x, v / 50); };
      double early = 0, late = 0;
      constexpr int kFrom = 2000, kTo = 6000, kWindow = 500;
      for (int tick = 0; tick < kTo + kWindow; ++tick) {
        const double difference = (x - old) / s.period;
        const double estimate = filtered ? b0 * (difference + 2 * in1 + in2) - a1 * out1 - a2 * out2 : difference;
        in2 = in1, in1 = difference, out2 = out1, out1 = estimate, old = x;
        waiting.push_back(-s.stiffness * x - s.damping * estimate);
        const double force = waiting.front();
        waiting.erase(waiting.begin());
        const double h = s.period / 100;
        for (int i = 0; i < 100; ++i) {
          const auto rate = [&](double at, double pace) { return (force - s.friction * pace - s.handStiffness * at) / s.mass; };
          const double half = v + h / 2 * rate(x, v), there = x + h / 2 * v;
          x += h * half, v += h * rate(there, half);
        }
        // Kept within what a double can hold: the loop is linear.
        if (tick >= kFrom && tick < kFrom + kWindow) early = std::max(early, energy());
        if (tick >= kTo) late = std::max(late, energy());
      }
      EXPECT_NEAR(std::log(spectralRadius(s)), std::log(late / early) / (kTo - kFrom), 2e-5) << filtered << delay;
    }
}

TEST(LoopStability, ColgatesMarginIsWhatFrictionIsLeft) {
  EXPECT_NEAR(passivityMargin({.stiffness = 800, .damping = -0.3, .friction = 1.2, .period = 2e-3, .estimator = {}}), 1.2 - 0.8 - 0.3,
              1e-12);
}

TEST(LoopStability, TheLargestStiffnessIsFoundToAThousandthOrIsTheMostThatWasAsked) {
  const double largest = largestStableStiffness(passiveArm(1));
  LoopSettings s = passiveArm(1);
  s.stiffness = largest;
  EXPECT_TRUE(isStable(s));
  s.stiffness = largest * 1.0011;
  EXPECT_FALSE(isStable(s));
  EXPECT_EQ(largestStableStiffness(passiveArm(1), 200), 200);
  LoopSettings unstable = passiveArm(0);
  unstable.friction = 0;
  EXPECT_LE(largestStableStiffness(unstable), 1e-3) << "none is stable without friction";
}

TEST(StabilityMap, EachRowIsTheLoopWithItsHandAndDamping) {
  DeviceModel model = *findDeviceModel("premium15");
  model.viscosity = 0.4;
  const auto map = computeStabilityMap(model, {.handMass = 0.2,
                                               .handDampings = {2, 0.5},
                                               .mostDamping = 1.2,
                                               .dampingStep = 0.4,
                                               .delayTicks = 1,
                                               .estimator = {.kind = "difference"}});
  ASSERT_EQ(map.size(), 8u);
  for (std::size_t i = 0; i < map.size(); ++i) {
    LoopSettings loop;
    loop.mass = 0.275, loop.friction = 0.4 + (i < 4 ? 2 : 0.5), loop.damping = 0.4 * static_cast<double>(i % 4), loop.delayTicks = 1;
    loop.estimator.kind = "difference";
    EXPECT_EQ(map[i].handDamping, i < 4 ? 2 : 0.5) << i;
    EXPECT_NEAR(map[i].damping, loop.damping, 1e-15) << i;
    EXPECT_NEAR(map[i].largestStable, largestStableStiffness(loop), 1e-9) << i;
    EXPECT_NEAR(map[i].largestPassive, std::max(0.0, 2000 / 3.0 * (loop.friction - loop.damping)), 1e-9) << i;
  }
  EXPECT_EQ(map[7].largestPassive, 0) << "0.9 less 1.2";
}

TEST(StabilityMap, SettingsOutOfRangeGiveNothing) {
  const DeviceModel& model = *findDeviceModel("omni");
  const auto rows = [&](double most, double step) {
    return computeStabilityMap(model, {.handDampings = {1}, .mostDamping = most, .dampingStep = step, .estimator = {}}).size();
  };
  EXPECT_EQ(rows(1, 0), 0u);
  EXPECT_EQ(rows(1, -1), 0u);
  EXPECT_EQ(rows(-1, 1), 0u);
  EXPECT_EQ(rows(NAN, 1), 0u);
  EXPECT_EQ(rows(0, 1), 1u);
  EXPECT_EQ(rows(0.3, 0.1), 4u) << "the last one too, though 0.3/0.1 is less than 3";
}

}  // namespace
}  // namespace reachlab::devices
