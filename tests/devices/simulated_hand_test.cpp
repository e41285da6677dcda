#include "devices/simulated/simulated_hand.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "base/fault.h"
#include "devices/make_device.h"
#include "sim/haptics/run_conductor.h"

namespace reachlab::devices {
namespace {

std::vector<haptics::ConductedTrial> conduct(const experiment::Experiment& experiment, const std::string& device, std::uint64_t seed,
                                             int trials, int first = 0) {
  haptics::LoopOptions options;
  options.virtualClock = true;
  std::vector<trial::PlannedTrial> planned;
  for (int i = 0; i < trials; ++i) planned.push_back({first + i});
  haptics::RunConductor run(experiment, makeDevice(device, experiment, seed), planned, options);
  run.start(nullptr);
  const std::atomic<bool> stop{false};
  std::vector<haptics::ConductedTrial> results;
  while (const auto trial = run.runTrial(stop)) results.push_back(*trial);
  return results;
}

int successes(const std::vector<haptics::ConductedTrial>& trials) {
  return static_cast<int>(
      std::count_if(trials.begin(), trials.end(), [](const auto& t) { return t.result.outcome == trial::Outcome::Success; }));
}

// What a hand does after the go signal.
std::vector<Vec3> motionOf(haptics::HapticDevice& device, int trial) {
  device.prepareTrial(trial);
  device.cue(haptics::Cue::Place);
  std::vector<Vec3> motion{device.read().position};
  device.cue(haptics::Cue::Go);
  for (int i = 0; i < 3000; ++i) motion.push_back(device.read().position);
  return motion;
}

TEST(SimulatedHand, WithoutNoiseItBringsEveryShippedObjectToRestEveryTime) {
  for (const std::string& name : experiment::shippedExperiments()) {
    const experiment::Experiment experiment = experiment::readExperiment(name);
    if (!experiment.task) continue;
    for (const haptics::ConductedTrial& t : conduct(experiment, "simulated:noise=0", 1, 2))
      EXPECT_EQ(t.result.outcome, trial::Outcome::Success)
          << name << " " << trial::nameOf(t.result.reason) << " mass " << t.result.mass << " by " << t.result.by;
  }
}

TEST(SimulatedHand, WithItsDefaultNoiseItFailsAsOftenAsAPersonLearning) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const auto trials = conduct(experiment::readExperiment("chain-moderate"), "simulated", seed, 20);
    EXPECT_GE(successes(trials), 6) << seed;
    EXPECT_LE(successes(trials), 18) << seed;
    std::set<trial::Reason> reasons;
    for (const haptics::ConductedTrial& t : trials)
      if (t.result.outcome == trial::Outcome::Failure) reasons.insert(t.result.reason);
    EXPECT_GE(reasons.size(), 2u) << seed;
  }
}

TEST(SimulatedHand, ATrialDependsOnSeedAndIndexAlone) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  const auto all = conduct(experiment, "simulated", 7, 4), last = conduct(experiment, "simulated", 7, 1, 3);
  EXPECT_EQ(all[3].result.by, last[0].result.by);
  EXPECT_EQ(all[3].result.movementTime, last[0].result.movementTime);

  const auto device = makeDevice("simulated", experiment, 7), other = makeDevice("simulated", experiment, 8);
  EXPECT_EQ(motionOf(*device, 3), motionOf(*device, 3));
  EXPECT_NE(motionOf(*device, 3), motionOf(*device, 2));
  EXPECT_NE(motionOf(*device, 3), motionOf(*other, 3));
}

TEST(SimulatedHand, WithoutNoiseItMovesAsTheCriterionPredicts) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  for (const char* criterion : {"min-hand-jerk", "min-hand-force-change"}) {
    predict::PredictOptions options;
    options.handMass = 1;
    const auto prediction = predict::predict(experiment, *predict::criterionFromName(criterion), options);
    const auto device = makeDevice(std::string("simulated:noise=0,reaction=0,hand-mass=1,criterion=") + criterion, experiment, 1);
    const auto motion = motionOf(*device, 0);
    for (const int tick : {100, 400, 675, 1000, 1349})
      EXPECT_NEAR(motion[tick].x + 0.1, prediction->handAt(tick * 1e-3).position, 1e-12) << criterion << ": sums of a thousand steps";
  }
}

TEST(SimulatedHand, MovementTimeVariesBySevenPercent) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  const auto device = makeDevice("simulated:speed-sd=0,reaction=0", experiment, 5);
  constexpr int kTrials = 200;
  double sum = 0, squares = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto motion = motionOf(*device, trial);
    std::size_t end = motion.size() - 1;
    while (end > 0 && motion[end - 1] == motion[end]) --end;
    const double ratio = static_cast<double>(end) * 1e-3 / 1.35;
    sum += ratio, squares += ratio * ratio;
  }
  const double mean = sum / kTrials, sd = std::sqrt(squares / kTrials - mean * mean);
  // Standard errors: sd/sqrt(200) = 0.005 of the mean, sd/sqrt(400) = 0.0035 of the SD; four of them.
  EXPECT_NEAR(mean, 1, 0.02);
  EXPECT_NEAR(sd, 0.07, 0.014);
}

TEST(SimulatedHand, ItsVelocityIsTheDerivativeOfItsPosition) {
  const auto device = makeDevice("simulated", experiment::readExperiment("chain-moderate"), 1);
  device->prepareTrial(0);
  device->cue(haptics::Cue::Place);
  device->read();
  device->cue(haptics::Cue::Go);
  haptics::DeviceSample before = device->read(), now = device->read();
  for (int i = 0; i < 1200; ++i) {
    const haptics::DeviceSample after = device->read();
    ASSERT_TRUE(now.hasVelocity);
    EXPECT_NEAR(norm(now.velocity - (after.position - before.position) / 0.002), 0, 1e-12) << "the same difference, rounded";
    before = now;
    now = after;
  }
}

TEST(SimulatedHand, RefusesACriterionWhereItFollowsNone) {
  for (const char* bent : {"ellipse", "chain-on-ellipse", "torus"}) {
    const experiment::Experiment experiment = experiment::readExperiment(bent);
    EXPECT_NO_THROW(makeDevice("simulated:noise=0", experiment, 1)) << bent;
    for (const char* device : {"simulated:criterion=min-hand-jerk", "simulated:criterion=min-crackle", "simulated:hand-mass=1"}) {
      try {
        makeDevice(device, experiment, 1);
        ADD_FAILURE() << bent << " takes " << device;
      } catch (const FaultError& error) {
        EXPECT_NE(std::string(error.what()).find("straight line"), std::string::npos) << error.what();
      }
    }
  }
}

TEST(SimulatedHand, SaysWhatItDoesNotUnderstand) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  for (const char* bad : {"simulated:nois=0", "simulated:noise=-1", "simulated:noise=nan", "simulated:noise=", "simulated:criterion=best",
                          "simulated:noise=1,,", "robot", "", "replay", "replay:"})
    EXPECT_THROW(makeDevice(bad, experiment, 1), FaultError) << bad;
  EXPECT_THROW(makeDevice("mouse", experiment, 1), ResourceError);
}

}  // namespace
}  // namespace reachlab::devices
