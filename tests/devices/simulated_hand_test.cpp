#include "devices/simulated/simulated_hand.h"

#include <gtest/gtest.h>

#include <set>

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
  const experiment::Experiment torus = experiment::readExperiment("torus");
  EXPECT_NO_THROW(makeDevice("simulated:noise=0", torus, 1));
  for (const char* device : {"simulated:criterion=min-hand-jerk", "simulated:criterion=min-crackle", "simulated:hand-mass=1"}) {
    try {
      makeDevice(device, torus, 1);
      ADD_FAILURE() << device;
    } catch (const FaultError& error) {
      EXPECT_NE(std::string(error.what()).find("not on the surface"), std::string::npos) << error.what();
    }
  }
  for (const char* bent : {"ellipse", "chain-on-ellipse"})
    EXPECT_THROW(makeDevice("simulated:criterion=min-crackle", experiment::readExperiment(bent), 1), RefusedError) << bent;
}

// The hand leads one mass by the spring's extension; the mass itself follows the prediction.
TEST(SimulatedHand, OnACurveTheObjectMovesAsTheCriterionPredicts) {
  for (const char* bent : {"ellipse", "chain-on-ellipse", "helix"}) {
    const experiment::CompiledExperiment experiment(experiment::readExperiment(bent));
    const auto prediction = predict::predict(experiment, predict::Criterion::MinHandJerk);
    haptics::TickEngine engine(experiment.experiment(), {.virtualHand = true});
    const auto hand = makeDevice("simulated:noise=0,reaction=0,criterion=min-hand-jerk", experiment, 1);
    hand->prepareTrial(0);
    haptics::TickInput input;
    input.command = trial::Command::NextTrial;
    double worst = 0, peak = 0;
    for (int tick = 0, since = -1; since < static_cast<int>(prediction->duration * 1000) && tick < 5000; ++tick) {
      input.device = hand->read();
      engine.tick(input);
      input.command = trial::Command::None;
      if (engine.state().phase == trial::Phase::Done) break;
      if (since >= 0) ++since;
      if (const auto cue = engine.cue()) hand->cue(*cue), since = *cue == haptics::Cue::Go ? 0 : -1;
      if (since <= 0) continue;
      const double moved = norm(engine.state().masses[static_cast<std::size_t>(engine.state().massCount) - 1].v);
      const double predicted = std::abs(prediction->objectVelocityAt(since * 1e-3));
      worst = std::max(worst, std::abs(moved - predicted));
      peak = std::max(peak, predicted);
    }
    ASSERT_GT(peak, 0.1) << bent;
    // One mass: the coupling's damper left out of the lead would make it 1 % on the ellipse and 4.7 % on the helix, where the lead turns
    // fastest. Several masses have no lead: their plan counts on the springs alone, and the damper makes 1 %.
    const bool one = engine.state().massCount == 1;
    EXPECT_LT(worst, (one ? 0.005 : 0.02) * peak) << bent << " " << worst / peak;
  }
}

TEST(SimulatedHand, SaysWhatItDoesNotUnderstand) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  for (const char* bad : {"simulated:nois=0", "simulated:noise=-1", "simulated:noise=nan", "simulated:noise=", "simulated:criterion=best",
                          "simulated:noise=1,,", "robot", "", "replay", "replay:"})
    EXPECT_THROW(makeDevice(bad, experiment, 1), FaultError) << bad;
  EXPECT_THROW(makeDevice("mouse", experiment, 1), ResourceError);
}

// A mass on a spring, m x'' = F + k (p - x): pushed by F from rest it is at 2 F/k half a period later, and back again after a whole one.
TEST(PartnerHand, OfTheStubbornSwingsWithThePeriodOfItsMassOnItsArm) {
  const auto hand = makeDevice("partner:stubborn,hand-mass=2,arm-stiffness=200,arm-damping=0", experiment::readExperiment("chain-slow"), 1);
  hand->cue(haptics::Cue::Place);
  const double start = hand->read().position.x;
  const int half = 314;  // [ms] pi sqrt(2/200)
  double far = 0;
  for (int i = 0; i < 2 * half; ++i) {
    hand->write({3, 0, 0});
    const double x = hand->read().position.x - start;
    if (i == half - 1) far = x;
    if (i == 2 * half - 1) EXPECT_NEAR(x, 0, 1e-4);
  }
  EXPECT_NEAR(far, 2 * 3 / 200.0, 1e-4);
}

}  // namespace
}  // namespace reachlab::devices
