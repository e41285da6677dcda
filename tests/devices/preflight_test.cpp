#include "devices/preflight/preflight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "devices/make_device.h"
#include "devices/preflight/reach_demand.h"
#include "devices/virtual/loop_stability.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/trial/protocol.h"
#include "tests/bare_reach.h"
#include "tests/refusal.h"

namespace reachlab::devices {
namespace {

haptics::DeviceInfo infoOf(const std::string& device, const experiment::Experiment& experiment) {
  return makeDevice(device, experiment, 1)->info();
}

std::vector<PreflightLine> check(const experiment::Experiment& experiment, const haptics::DeviceInfo& info) {
  return checkBeforeBlock(experiment::CompiledExperiment(experiment), info);
}

std::vector<std::string> warnings(const experiment::CompiledExperiment& scene, haptics::HapticDevice& device) {
  return warningsBeforeBlock(std::span(&scene, 1), device);
}

PreflightLine lineOf(const std::vector<PreflightLine>& lines, const std::string& name) {
  for (const PreflightLine& line : lines)
    if (line.name == name) return line;
  ADD_FAILURE() << "no line " << name;
  return {};
}

experiment::Experiment stiffPoint(double mass, double duration) {
  experiment::Experiment e = experiment::readExperiment("chain-slow");
  e.object = {};
  e.object.masses = {mass};
  e.coupling = {20'000, 20};
  e.task->duration = duration;
  return e;
}

// Newton's law on a minimum-jerk reach: F = m (10/sqrt 3) d/T^2, rms sqrt(120/7) of the same unit. A coupling of 20 kN/m is stiff beside a
// reach of 1 s (the hand leads the mass by 0.2 mm of 200), so 2 % hold.
TEST(ReachDemand, OfAPointOnAStiffCouplingIsNewtonsLaw) {
  const ReachDemand demand = computeReachDemand(experiment::CompiledExperiment(stiffPoint(0.7, 1.0)));
  const double unit = 0.7 * 0.2 / (1.0 * 1.0);
  EXPECT_NEAR(demand.peakForce, 10 / std::sqrt(3.0) * unit, 0.02 * 10 / std::sqrt(3.0) * unit);
  // Onset (1 mm) to end, not 0 to T: the still parts that are left out raise the mean.
  EXPECT_GT(demand.rmsForce, std::sqrt(120.0 / 7) * unit * 0.98);
  EXPECT_LT(demand.rmsForce, std::sqrt(120.0 / 7) * unit * 1.25);
  EXPECT_NEAR(demand.farthest, 0.1, 2e-3);
}

TEST(Preflight, TheLongerReachItNamesIsFine) {
  experiment::Experiment experiment = experiment::readExperiment("chain-fast");
  const auto info = infoOf("virtual:omni", experiment);
  const PreflightLine peak = lineOf(check(experiment, info), "peak_force");
  EXPECT_EQ(peak.verdict, Verdict::Warning);
  EXPECT_EQ(peak.limit, 3.3);
  // As a rigid body: 3 kg (10/sqrt 3) 0.2 m/(0.68 s)^2 = 7.5 N; a chain sways, so it may be more or less, but not by half.
  EXPECT_GT(peak.asked, 5.0);
  EXPECT_LT(peak.asked, 11.3);
  const std::string& remedy = peak.remedy;
  const std::size_t at = remedy.find("duration_s ");
  ASSERT_NE(at, std::string::npos) << remedy;
  experiment.task->duration = std::stod(remedy.substr(at + 11)) * 1.005;  // it is written with three digits
  const PreflightLine again = lineOf(check(experiment, info), "peak_force");
  EXPECT_EQ(again.verdict, Verdict::Fine) << describe(again);
  EXPECT_GT(again.asked, 0.8 * 3.3) << "and it is not much longer than it must be";
}

TEST(Preflight, AnExperimentsLowerLimitHoldsItsHigherOneDoesNot) {
  experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  const auto info = infoOf("virtual:premium15", experiment);
  experiment.forceLimit = 0.5;
  EXPECT_EQ(lineOf(check(experiment, info), "peak_force").verdict, Verdict::Warning);
  experiment.forceLimit = 20;
  EXPECT_EQ(lineOf(check(experiment, info), "peak_force").limit, 8.5);
}

// What a reach along a curve needs is no closed form: a practised reach tells it, of the whole mass at its peak.
TEST(Preflight, AReachAlongACurveIsCarriedOutToBeWeighed) {
  const experiment::CompiledExperiment ellipse(experiment::readExperiment("chain-on-ellipse"));
  const ReachDemand demand = computeReachDemand(ellipse, std::nullopt, {});
  EXPECT_EQ(demand.law, "a practised reach, simulated");
  EXPECT_GT(demand.rmsForce, 0);
  EXPECT_LT(demand.rmsForce, demand.peakForce);
}

// Abbott and Okamura 2005: dry friction c swallows the steps of a device of resolution r up to a stiffness of 2 c/r.
TEST(Preflight, DryFrictionThatSwallowsTheStepsIsToldWithItsStiffness) {
  const auto experiment = experiment::readExperiment("chain-moderate");  // 600 N/m
  haptics::DeviceInfo info = infoOf("virtual:premium15", experiment);
  info.resolution = 1e-4, info.coulombFriction = 0.04;
  EXPECT_TRUE(holds(lineOf(check(experiment, info), "passivity").sentence, "up to k_h = 800 N/m"));
  info.coulombFriction = 0;
  EXPECT_FALSE(holds(lineOf(check(experiment, info), "passivity").sentence, "dry friction"));
}

TEST(Preflight, AReachBeyondTheWorkspaceNamesTheScale) {
  const auto experiment = experiment::readExperiment("chain-slow");
  const PreflightLine line = lineOf(check(experiment, infoOf("virtual:omega3", experiment)), "workspace");
  EXPECT_EQ(line.verdict, Verdict::Warning) << "0.1 m on a radius of 0.075 m";
  EXPECT_TRUE(holds(line.remedy, "a scale 1.33 times as large"));
}

TEST(Preflight, EachOfTwoHandsIsHeldAgainstItsOwnDevice) {
  const experiment::CompiledExperiment both(experiment::readExperiment("chain-two-hands"));
  const auto device = makeDevice("virtual:highforce + virtual:omni", both, 1);
  const auto lines = checkBeforeBlock(both, *device);
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_EQ(lines[0].hand, 1);
  EXPECT_EQ(lines[0].limit, 37.5);
  EXPECT_EQ(lines[5].hand, 2);
  EXPECT_EQ(lines[5].limit, 3.3);
  const std::vector<std::string> weak = warnings(both, *makeDevice("virtual:highforce + virtual:omni,arm-mass=1", both, 1));
  ASSERT_FALSE(weak.empty());
  for (const std::string& sentence : weak) EXPECT_TRUE(sentence.starts_with("hand 2: ")) << sentence;
  EXPECT_TRUE(warnings(both, *makeDevice("simulated + simulated", both, 1)).empty()) << "they feel nothing";
}

// In parallel-two-hands the second hand's springs are the first one's the other way round, here made ten times stiffer.
TEST(Preflight, TheSecondHandIsAskedForItsOwnSprings) {
  experiment::Experiment springs = experiment::readExperiment("parallel-two-hands");
  for (double& stiffness : springs.hands.at(1).stiffness) stiffness *= 10;
  const experiment::CompiledExperiment both(springs);
  const auto lines = checkBeforeBlock(both, *makeDevice("virtual:highforce + virtual:highforce", both, 1));
  EXPECT_EQ(lineOf({lines.begin(), lines.begin() + 5}, "stability").asked, 300);
  EXPECT_EQ(lineOf({lines.begin() + 5, lines.end()}, "stability").asked, 3000);
}

TEST(Preflight, EveryShippedExperimentIsJudged) {
  for (const std::string& name : experiment::shippedExperiments()) {
    const auto experiment = experiment::readExperiment(name);
    if (!experiment.task) continue;
    const auto lines = check(experiment, {.name = "device", .rendersForce = true});
    const bool bare = experiment.object.kind == experiment::ObjectKind::None, pushed = !experiment.environment.empty();
    ASSERT_EQ(lines.size(), (bare ? 3u : 5u) + (pushed ? 1u : 0u)) << name;
    EXPECT_TRUE(std::isfinite(lines[0].asked)) << name;
    EXPECT_EQ(lines[0].asked > 0, !bare || pushed) << name;
    EXPECT_EQ(lines[1].verdict, Verdict::Unknown) << name << ": what the device does not tell is not called fine";
  }
}

haptics::DeviceInfo plainDevice() {
  return {.name = "plain",
          .maxForce = 100,
          .maxContinuousForce = 100,
          .rendersForce = true,
          .workspaceRadius = 1,
          .apparentMass = 0.1,
          .viscosity = 5};
}

// Of several hands one may bear all of it alone: Newton's law on a minimum-jerk reach of the whole mass, and its weight.
TEST(ReachDemand, OfSeveralHandsIsThatOfARigidBody) {
  experiment::Experiment e = experiment::readExperiment("chain-two-hands");
  e.object.gravity = {0, -2, 0};
  const experiment::CompiledExperiment both(e);
  double mass = 0;
  for (const double one : e.object.masses) mass += one;
  const ReachDemand demand = computeReachDemand(both, 0.8, {0.02, 0, 0});
  const trial::ProtocolSettings place = trial::makeProtocolSettings(e, both.constraint());
  const double unit = mass * norm(place.target - place.start) / 0.64;
  EXPECT_NEAR(demand.peakForce, 10 / std::sqrt(3.0) * unit + 2 * mass, 1e-9);
  EXPECT_NEAR(demand.rmsForce, std::sqrt(120.0 / 7 * unit * unit + 4 * mass * mass), 1e-9);
  EXPECT_NEAR(demand.farthest, std::max(norm(place.start - Vec3{0.02, 0, 0}), norm(place.target - Vec3{0.02, 0, 0})), 1e-15);
  EXPECT_EQ(demand.duration, 0.8);
  EXPECT_EQ(demand.law, "its whole mass as one rigid body (one of its hands may bear it alone)");
}

TEST(ReachDemand, IsThatOfTheDurationThatIsAskedForWhateverTheLimit) {
  experiment::Experiment e = stiffPoint(0.7, 1.0);
  const ReachDemand usual = computeReachDemand(experiment::CompiledExperiment(e));
  EXPECT_EQ(usual.duration, 1);
  e.forceLimit = 0.1;
  e.forceLimitEndsTrial = true;
  const ReachDemand limited = computeReachDemand(experiment::CompiledExperiment(e)),
                    slow = computeReachDemand(experiment::CompiledExperiment(e), 2.0);
  EXPECT_EQ(limited.peakForce, usual.peakForce) << "unclamped";
  EXPECT_NEAR(slow.peakForce, usual.peakForce / 4, 0.01 * usual.peakForce);
  EXPECT_EQ(slow.duration, 2);
  EXPECT_NEAR(computeReachDemand(experiment::CompiledExperiment(e), std::nullopt, {0.05, 0, 0}).farthest, 0.15, 2e-3);
}

TEST(Preflight, AForceIsClampedBeyondTheDevicesOwn) {
  const experiment::CompiledExperiment e(stiffPoint(0.7, 1.0));
  const double peak = computeReachDemand(e).peakForce;
  haptics::DeviceInfo info = plainDevice();
  info.maxForce = peak;
  const PreflightLine enough = lineOf(checkBeforeBlock(e, info), "peak_force");
  EXPECT_EQ(enough.verdict, Verdict::Fine);
  EXPECT_EQ(enough.unit, "N");
  EXPECT_EQ(enough.remedy, "");
  info.maxForce = 0.25 * peak;
  const PreflightLine less = lineOf(checkBeforeBlock(e, info), "peak_force");
  EXPECT_EQ(less.verdict, Verdict::Warning);
  EXPECT_TRUE(less.sentence.ends_with("N: the force will be clamped")) << less.sentence;
  EXPECT_TRUE(holds(less.remedy, "a reach or masses scaled by 0.25, or a device of "));
  EXPECT_TRUE(holds(less.remedy, "a longer reach (duration_s 2.0")) << "a fourth of the force in twice the time: " << less.remedy;
  EXPECT_TRUE(holds(less.remedy, " instead of 1)"));
}

// A weight stays however slowly it is moved.
TEST(Preflight, WhereALongerReachDoesNotHelpThatIsSaid) {
  experiment::Experiment e = experiment::readExperiment("chain-two-hands");
  e.object.gravity = {0, -9.81, 0};
  haptics::DeviceInfo info = plainDevice();
  info.maxForce = 1;
  const PreflightLine line = lineOf(check(e, info), "peak_force");
  EXPECT_TRUE(line.remedy.starts_with("a longer reach does not help (a force that rests on it stays), ")) << line.remedy;
}

// A share s of what is needed: the motors cool to it in pauses of (1/s^2 - 1) of the movements.
TEST(Preflight, PausesLetTheMotorsCool) {
  const experiment::CompiledExperiment e(stiffPoint(0.7, 1.0));
  const double rms = computeReachDemand(e).rmsForce;
  haptics::DeviceInfo info = plainDevice();
  info.maxContinuousForce = rms;
  EXPECT_EQ(lineOf(checkBeforeBlock(e, info), "continuous_force").verdict, Verdict::Fine);
  EXPECT_EQ(lineOf(checkBeforeBlock(e, info), "continuous_force").limit, rms);
  info.maxContinuousForce = rms / 2;
  const PreflightLine half = lineOf(checkBeforeBlock(e, info), "continuous_force");
  EXPECT_EQ(half.verdict, Verdict::Warning);
  EXPECT_TRUE(half.remedy.starts_with("pauses 3 times as long as the movements, or a longer reach")) << half.remedy;
  EXPECT_TRUE(half.sentence.ends_with(": its motors warm up, and the peak will be taken back")) << half.sentence;
  info.maxContinuousForce = 0;
  const PreflightLine unknown = lineOf(checkBeforeBlock(e, info), "continuous_force");
  EXPECT_EQ(unknown.verdict, Verdict::Unknown);
  EXPECT_FALSE(unknown.limit);
  EXPECT_TRUE(unknown.sentence.ends_with("what plain can hold continuously is not known")) << unknown.sentence;
}

TEST(Preflight, PassivityAsksForHalfTheStiffnessTimesThePeriodAndTheDamping) {
  experiment::Experiment e = stiffPoint(0.7, 1.0);
  e.coupling = {4000, 2};
  haptics::DeviceInfo info = plainDevice();
  info.rate = 0;
  const auto passivity = [&](double viscosity) {
    info.viscosity = viscosity;
    return lineOf(check(e, info), "passivity");
  };
  EXPECT_NEAR(passivity(4).asked, 4000 * 0.001 / 2 + 2, 1e-12) << "no rate told: the tick's";
  EXPECT_EQ(passivity(4).verdict, Verdict::Fine);
  EXPECT_EQ(passivity(4).limit, 4);
  EXPECT_EQ(passivity(4).unit, "N s/m");
  EXPECT_EQ(passivity(3.5).verdict, Verdict::Held);
  EXPECT_EQ(passivity(3).verdict, Verdict::Held) << "1 N s/m is what the lightest hand brings";
  EXPECT_TRUE(holds(passivity(3).sentence, "the hand must bring 1 N s/m, as any hand that holds it does"));
  EXPECT_EQ(passivity(2.9).verdict, Verdict::Warning);
  EXPECT_TRUE(holds(passivity(2.9).sentence, "more than a light grasp does"));
  EXPECT_EQ(passivity(2.9).remedy, "a coupling of k_h <= 3800 N/m") << "2 (1 + 2.9 - 2)/T";
  EXPECT_EQ(passivity(0.5).remedy, "less coupling damping than b_h = 2 N s/m");
  info.rate = 4000;
  EXPECT_NEAR(passivity(4).asked, 4, 1e-12) << "no faster than the tick";
  EXPECT_TRUE(passivity(4).sentence.starts_with("k_h = 4000 N/m and b_h = 2 N s/m at 1000 Hz ask for 4 N s/m of viscous friction"))
      << passivity(4).sentence;
}

// The device and 0.3 kg of a hand, its friction and the hand's 3 N s/m.
TEST(Preflight, StabilityIsThatOfARelaxedHand) {
  experiment::Experiment e = stiffPoint(0.7, 1.0);
  e.coupling = {1500, 4};
  e.velocityEstimator.kind = "difference";
  haptics::DeviceInfo info = plainDevice();
  info.rate = 500;
  const double largest =
      largestStableStiffness({.damping = 4, .mass = 0.4, .friction = 8, .period = 2e-3, .estimator = e.velocityEstimator});
  const PreflightLine line = lineOf(check(e, info), "stability");
  EXPECT_NEAR(line.limit.value_or(0), largest, 1e-9);
  EXPECT_EQ(line.asked, 1500);
  EXPECT_EQ(line.unit, "N/m");
  e.coupling->stiffness = largest * 1.01;
  const PreflightLine stiff = lineOf(check(e, info), "stability");
  EXPECT_EQ(stiff.verdict, Verdict::Warning);
  EXPECT_TRUE(stiff.remedy.starts_with("a coupling of k_h <= ")) << stiff.remedy;
  info.apparentMass = 0;
  EXPECT_EQ(lineOf(check(e, info), "stability").verdict, Verdict::Unknown);
  EXPECT_FALSE(lineOf(check(e, info), "stability").limit);
}

// Places are scaled and forces are not: at the device a coupling is as many times as stiff, and so is the wall.
TEST(Preflight, AScaledDeviceIsHeldAgainstTheStiffnessThatItFeels) {
  const experiment::Experiment e = experiment::readExperiment("chain-moderate");
  const auto limitOn = [&](const std::string& device) { return lineOf(check(e, infoOf(device, e)), "stability").limit.value_or(0); };
  const double plain = limitOn("virtual:premium15");
  EXPECT_GT(plain, 600);
  EXPECT_NEAR(limitOn("virtual:premium15,scale=10"), plain / 10, 1e-4 * plain) << "as near as it is looked for";
  EXPECT_EQ(lineOf(check(e, infoOf("virtual:premium15,scale=11", e)), "stability").verdict, Verdict::Warning);
  const haptics::DeviceInfo scaled = infoOf("virtual:premium15,scale=10,wall=yes", e), usual = infoOf("virtual:premium15,wall=yes", e);
  EXPECT_NEAR(scaled.guards.wallStiffness, usual.guards.wallStiffness / 10, 1e-9);
  EXPECT_NEAR(scaled.guards.wallDamping, usual.guards.wallDamping / 10, 1e-9);
}

// Springs of parallel masses are felt together; those of a hand of its own where it has them.
TEST(Preflight, TheStiffnessIsWhatTheHandFeelsOfAllItsSprings) {
  experiment::Experiment e = experiment::readExperiment("parallel");
  double stiffness = 0;
  for (const double k : e.object.stiffness) stiffness += k;
  ASSERT_FALSE(e.coupling);
  EXPECT_EQ(lineOf(check(e, plainDevice()), "stability").asked, stiffness);
  EXPECT_TRUE(warnings(experiment::CompiledExperiment(e), *makeDevice("simulated", e, 1)).empty());
}

experiment::Experiment reachUnder(const experiment::Environment& environment) {
  experiment::Experiment e = experiment::bareReach();
  e.velocityEstimator = {"butterworth", 40};
  e.environment = environment;
  return e;
}

TEST(Preflight, AChannelIsHeldAgainstTheDevicesLimitOfStability) {
  experiment::ChannelForce wall;
  wall.damping = 2;
  const auto lineFor = [&](double stiffness) {
    wall.stiffness = stiffness;
    const experiment::Experiment e = reachUnder({{wall, experiment::ForceWhen::Trial}});
    return lineOf(check(e, infoOf("virtual:omni", e)), "channel");
  };
  const PreflightLine soft = lineFor(500);
  ASSERT_TRUE(soft.limit);
  const haptics::DeviceInfo info = infoOf("virtual:omni", reachUnder({}));
  const LoopSettings loop{.damping = 2, .mass = info.apparentMass + 0.3, .friction = info.viscosity + 3, .estimator = {"butterworth", 40}};
  EXPECT_NEAR(*soft.limit, largestStableStiffness(loop), 1e-9);
  EXPECT_EQ(soft.verdict, Verdict::Fine);
  EXPECT_TRUE(holds(soft.sentence, "Colgate"));
  const PreflightLine stiff = lineFor(1.01 * *soft.limit);
  EXPECT_EQ(stiff.verdict, Verdict::Warning);
  EXPECT_TRUE(holds(stiff.remedy, "stiffness_n_per_m <= "));
}

// b v^2 sin(w d) with v = w r, r = 5 cm, w = pi/0.5 s, and the delay of a Butterworth filter of 40 Hz on differences.
TEST(Preflight, ACurlFieldsPowerIsThatOfTheLagOfTheVelocity) {
  const double b = 13, omega = std::numbers::pi / 0.5, speed = omega * 0.05;
  const double delay = 0.5e-3 + std::numbers::sqrt2 / (2 * std::numbers::pi * 40);
  const auto powerOf = [&](const experiment::SquareMatrix<3>& matrix) {
    const experiment::Experiment e = reachUnder({{experiment::ViscousForce{matrix}}});
    for (const PreflightLine& line : check(e, infoOf("virtual:omni", e)))
      if (line.name == "field_power") return line.asked;
    return 0.0;
  };
  EXPECT_NEAR(powerOf({{{0, 0, b}, {0, 0, 0}, {-b, 0, 0}}}), b * speed * speed * std::sin(omega * delay), 1e-12);
  EXPECT_EQ(powerOf({{{-10.1, 0, 11.2}, {0, 0, 0}, {11.2, 0, 11.1}}}), 0) << "a symmetric field is no curl field";
}

TEST(Preflight, TheForceOfAFieldCountsAmongTheForcesOfAReach) {
  const double b = 13;
  const experiment::Experiment e = reachUnder({{experiment::ViscousForce{{{{0, 0, b}, {0, 0, 0}, {-b, 0, 0}}}}}});
  const PreflightLine peak = lineOf(check(e, infoOf("virtual:omni", e)), "peak_force");
  EXPECT_NEAR(peak.asked, b * 1.875 * 0.1 / 0.5, 0.1) << "b times the peak speed of a minimum-jerk reach";
}

// The subject may leave the start later than the task allows: the force is that of the field all the same.
TEST(Preflight, AFieldCountsThoughTheOnsetComesLate) {
  experiment::Experiment e = experiment::readExperiment("centre-out");
  e.environment = {{experiment::ViscousForce{{{{0, 0, 130}, {0, 0, 0}, {-130, 0, 0}}}}}};
  const double inTime = computeReachDemand(experiment::CompiledExperiment(e)).peakForce;
  e.task->timeout = 0.25;
  EXPECT_GT(inTime, 10);
  EXPECT_EQ(computeReachDemand(experiment::CompiledExperiment(e)).peakForce, inTime);
  const PreflightLine line = lineOf(check(e, infoOf("virtual:omni", e)), "peak_force");
  EXPECT_TRUE(holds(line.remedy, "a longer reach (duration_s ")) << "half the speed, half the force";
  e.environment = {{experiment::PulseForce{{300, 0, 0}, {.onset = 0.1, .distance = {}}}}};
  const PreflightLine pulse = lineOf(check(e, infoOf("virtual:omni", e)), "peak_force");
  EXPECT_TRUE(holds(pulse.remedy, "a longer reach does not help"));
  EXPECT_TRUE(holds(pulse.remedy, "a reach, masses or environment scaled by"));
}

TEST(Preflight, WhatIsComputedWithoutTheEnvironmentIsNoPromise) {
  experiment::Experiment e = experiment::readExperiment("centre-out");
  e.environment = {{experiment::ViscousForce{{{{0, 0, 130}, {0, 0, 0}, {-130, 0, 0}}}}}};
  const haptics::DeviceInfo omni = infoOf("virtual:omni", e);
  e.task->via = {{0, 0, -0.05}};
  const PreflightLine line = lineOf(check(e, omni), "peak_force");
  EXPECT_EQ(line.verdict, Verdict::Unknown);
  EXPECT_TRUE(holds(line.sentence, "the forces of the environment are not counted"));
}

}  // namespace
}  // namespace reachlab::devices
