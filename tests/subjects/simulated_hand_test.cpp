#include "sim/subjects/plans/simulated_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "base/fault.h"
#include "devices/make_device.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/subjects/plans/played_hand.h"
#include "sim/subjects/plans/sampled_plan.h"
#include "sim/subjects/subject_kinds.h"
#include "tests/refusal.h"
#include "tests/subjects/conducted.h"

namespace reachlab::subjects {
namespace {

std::vector<haptics::ConductedTrial> conduct(const experiment::Experiment& experiment, const std::string& device, std::uint64_t seed,
                                             int trials, int first = 0) {
  return subjects::conduct(experiment::CompiledExperiment(experiment), devices::makeDevice(device, experiment, seed), trials, first);
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
    if (!experiment.task || !experiment.environment.empty()) continue;  // a plan cannot be pushed aside
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

  const auto device = devices::makeDevice("simulated", experiment, 7), other = devices::makeDevice("simulated", experiment, 8);
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
    const auto device = devices::makeDevice(std::string("simulated:noise=0,reaction=0,hand-mass=1,criterion=") + criterion, experiment, 1);
    const auto motion = motionOf(*device, 0);
    for (const int tick : {100, 400, 675, 1000, 1349})
      EXPECT_NEAR(motion[tick].x + 0.1, prediction->handAt(tick * 1e-3).position, 1e-12) << criterion << ": sums of a thousand steps";
  }
}

TEST(SimulatedHand, MovementTimeVariesBySevenPercent) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  const auto device = devices::makeDevice("simulated:speed-sd=0,reaction=0", experiment, 5);
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
  const auto device = devices::makeDevice("simulated", experiment::readExperiment("chain-moderate"), 1);
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
  EXPECT_NO_THROW(devices::makeDevice("simulated:noise=0", torus, 1));
  for (const char* device : {"simulated:criterion=min-hand-jerk", "simulated:criterion=min-crackle", "simulated:hand-mass=1"}) {
    EXPECT_TRUE(holds(refusalOf([&] { devices::makeDevice(device, torus, 1); }), "not on the surface"));
  }
  for (const char* bent : {"ellipse", "chain-on-ellipse"})
    EXPECT_THROW(devices::makeDevice("simulated:criterion=min-crackle", experiment::readExperiment(bent), 1), RefusedError) << bent;
}

// The hand leads one mass by the spring's extension; the mass itself follows the prediction.
TEST(SimulatedHand, OnACurveTheObjectMovesAsTheCriterionPredicts) {
  for (const char* bent : {"ellipse", "chain-on-ellipse", "helix"}) {
    const experiment::CompiledExperiment experiment(experiment::readExperiment(bent));
    const auto prediction = predict::predict(experiment, predict::Criterion::MinHandJerk);
    haptics::TickEngine engine(experiment.experiment(), {{{.virtualHand = true}}});
    const auto hand = devices::makeDevice("simulated:noise=0,reaction=0,criterion=min-hand-jerk", experiment, 1);
    hand->prepareTrial(0);
    double worst = 0, peak = 0;
    int since = -1;
    reachTickByTick(engine, *hand, [&](const haptics::DeviceSample&, std::optional<haptics::Cue> cue) {
      if (engine.state().phase == trial::Phase::Done) return false;
      if (since >= 0) ++since;
      if (cue) since = *cue == haptics::Cue::Go ? 0 : -1;
      if (since <= 0) return true;
      const double moved = norm(engine.state().masses[static_cast<std::size_t>(engine.state().massCount) - 1].v);
      const double predicted = std::abs(prediction->objectVelocityAt(since * 1e-3));
      worst = std::max(worst, std::abs(moved - predicted));
      peak = std::max(peak, predicted);
      return since < static_cast<int>(prediction->duration * 1000);
    });
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
    EXPECT_THROW(devices::makeDevice(bad, experiment, 1), FaultError) << bad;
  EXPECT_THROW(devices::makeDevice("mouse", experiment, 1), ResourceError);
}

// The same body with a damper: x = F/k (1 - e^{-dt}(cos wt + d/w sin wt)), d = b/2m, w^2 = k/m - d^2; on every axis alike.
TEST(PartnerHand, OfTheStubbornIsADampedMassOnItsArm) {
  const experiment::Experiment experiment = experiment::readExperiment("free-point");
  const auto hand = devices::makeDevice("partner:stubborn,hand-mass=0.8,arm-stiffness=90,arm-damping=3", experiment, 1);
  const Vec3 start{-0.1, 0, 0}, force{0.5, -0.25, 0.125};
  const double d = 3 / 1.6, w = std::sqrt(90 / 0.8 - d * d);
  for (int run = 0; run < 2; ++run) {
    hand->cue(haptics::Cue::Place);
    EXPECT_EQ(hand->read().position, start) << "at rest again";
    for (int tick = 1; tick <= 1500; ++tick) {
      hand->write(force);
      const haptics::DeviceSample sample = hand->read();
      const double t = 1e-3 * tick, way = (1 - std::exp(-d * t) * (std::cos(w * t) + d / w * std::sin(w * t))) / 90;
      ASSERT_LT(norm(sample.position - start - way * force), 5e-6) << tick;
      const double pace = std::exp(-d * t) * (d * d + w * w) / w * std::sin(w * t) / 90;
      ASSERT_LT(norm(sample.velocity - pace * force), 1e-4) << tick;
      ASSERT_TRUE(sample.hasVelocity);
    }
  }
  hand->write({NAN, 0, 0});
  EXPECT_TRUE(isFinite(hand->read().position)) << "no number is no force";
  const haptics::DeviceInfo info = hand->info();
  EXPECT_EQ(info.name, "partner");
  EXPECT_EQ(info.version, "1");
  EXPECT_TRUE(info.virtualHand);
  EXPECT_FALSE(info.rendersForce);
  EXPECT_EQ(info.maxForce, 60);
  EXPECT_EQ(info.apparentMass, 0.8);
}

// So stiff that it is where it means to be: where the mass was one reaction time ago.
TEST(PartnerHand, OfTheFollowerIsWhereItSawTheMass) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-slow");
  const std::size_t masses = experiment.object.masses.size();
  ASSERT_GT(masses, 2u);
  for (const auto& [options, seen, delay] :
       {std::tuple{"", masses - 1, 150}, {",reaction=0.04", masses - 1, 40}, {",mass=2,reaction=0.04", std::size_t{1}, 40}}) {
    const auto hand =
        devices::makeDevice(std::string("partner:follower,hand-mass=0.05,arm-stiffness=20000,arm-damping=200") + options, experiment, 1);
    hand->cue(haptics::Cue::Place);
    const Vec3 start = hand->read().position;
    const auto placeAt = [&](std::size_t mass, int tick) {
      return start + (1 + static_cast<double>(mass)) * Vec3{0.01 * (1 - std::cos(0.01 * std::max(tick, 0))), 0.003, 0};
    };
    for (int tick = 0; tick < 600; ++tick) {
      std::vector<dynamics::MassState> states(masses);
      for (std::size_t i = 0; i < masses; ++i) states[i].r = placeAt(i, tick);
      hand->see(states);
      const Vec3 place = hand->read().position;
      if (tick < delay) {
        ASSERT_LT(norm(place - start), 1e-12) << options << tick;
      }
      // Its place trails by b v/k and m a/k: some 10 um here; the first moments after the jump are left out.
      if (tick > delay + 100) {
        ASSERT_LT(norm(place - placeAt(seen, tick - delay)), 6e-5) << options << tick;
      }
    }
  }
}

TEST(PartnerHand, OfTheLeaderMeansTheReachOfASubjectAlone) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-slow");
  const auto leader = devices::makeDevice("partner:leader,hand-mass=0.05,arm-stiffness=100000,arm-damping=400,noise=0", experiment, 3);
  const auto alone = devices::makeDevice("simulated:noise=0", experiment, 3);
  const auto led = motionOf(*leader, 1), meant = motionOf(*alone, 1);
  for (std::size_t i = 0; i < led.size(); ++i) ASSERT_LT(norm(led[i] - meant[i]), 2e-5) << i;
  EXPECT_NEAR(meant.back().x, 0.1, 1e-6);
}

PlayedReach numbered(int trial) {
  PlayedReach reach;
  for (int i = 0; i < 4; ++i) {
    reach.position.push_back({10.0 * trial + i, 0, 0});
    reach.velocity.push_back({100.0 * trial + i, 0, 0});
  }
  return reach;
}

TEST(PlayedHand, PlaysOneReachATrialFromTheSignalOnAndRestsAtBothEnds) {
  std::vector<int> planned;
  PlayedHand hand({}, [&](int trial) {
    planned.push_back(trial);
    return numbered(trial);
  });
  EXPECT_TRUE(hand.info().virtualHand);
  EXPECT_EQ(planned, std::vector<int>{0});
  EXPECT_EQ(hand.read().position.x, 0) << "before the first trial it rests where that begins";
  EXPECT_EQ(hand.read().velocity.x, 0);
  EXPECT_TRUE(hand.read().hasVelocity);
  hand.prepareTrial(0);
  EXPECT_EQ(planned.size(), 1u) << "the first is there already";
  hand.cue(haptics::Cue::Place);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(hand.read().position.x, 0) << "until the signal";
  hand.cue(haptics::Cue::Go);
  for (const double x : {1.0, 2.0, 3.0, 3.0, 3.0}) {
    const haptics::DeviceSample sample = hand.read();
    EXPECT_EQ(sample.position.x, x);
    EXPECT_EQ(sample.velocity.x, x < 3 ? x : 0) << "at rest at its end";
  }
  hand.prepareTrial(2);
  EXPECT_EQ(hand.read().position.x, 3) << "not before it is placed";
  hand.cue(haptics::Cue::Place);
  EXPECT_EQ(hand.read().position.x, 20);
  EXPECT_EQ(hand.read().velocity.x, 0);
  hand.cue(haptics::Cue::Go);
  EXPECT_EQ(hand.read().position.x, 21);
  EXPECT_EQ(hand.read().velocity.x, 202);
  hand.prepareTrial(0);
  EXPECT_EQ(planned, (std::vector<int>{0, 2, 0})) << "and again";
}

TEST(PlayedHand, WithoutAFirstReachItHasNoPlace) {
  PlayedHand hand({}, [](int trial) { return trial == 0 ? PlayedReach{} : PlayedReach{{{1, 2, 3}}, {}}; });
  EXPECT_FALSE(hand.read().valid);
  hand.prepareTrial(1);
  hand.cue(haptics::Cue::Place);
  EXPECT_TRUE(hand.read().valid);
  hand.cue(haptics::Cue::Go);
  EXPECT_EQ(hand.read().position, (Vec3{1, 2, 3}));
  EXPECT_FALSE(hand.read().hasVelocity) << "none is known";
}

// Polynomials of the fifth degree are met exactly; a kink is left to the plan itself.
TEST(SampledPlan, IsThePlanBetweenItsSamplesToo) {
  const auto quintic = [](double t) {
    return Vec3{1 + t * (2 - t * (3 - t * (1 + t * (0.5 - 0.7 * t)))), std::pow(t, 5), -std::pow(t, 4)};
  };
  for (const double duration : {0.0057, 0.006, 0.1234, 1.0}) {
    const SampledPlan plan({duration, quintic});
    EXPECT_EQ(plan.duration(), duration);
    for (int i = 0; i <= 997; ++i) {
      const double t = duration * i / 997;
      ASSERT_LT(norm(plan.at(t) - quintic(t)), 1e-14) << duration << " at " << t;
    }
  }
  int asked = 0;
  const auto counted = [&](double t) {
    ++asked;
    return quintic(t);
  };
  const auto asksAt = [&](const ReachPlan& made) {
    const SampledPlan plan(made);
    asked = 0;
    (void)plan.at(0.3 * made.duration);
    return asked;
  };
  EXPECT_EQ(asksAt({0.1, counted}), 0) << "from the samples";
  EXPECT_EQ(asksAt({0.006, counted}), 0) << "six cells are enough";
  EXPECT_EQ(asksAt({0.005, counted}), 1) << "five are not";
  const auto kinked = [&](double t) {
    ++asked;
    return Vec3{std::abs(t - 0.0505), 0, 0};
  };
  EXPECT_EQ(asksAt({0.1, kinked}), 1);
  EXPECT_EQ(SampledPlan({0.1, kinked}).at(0.0505).x, 0);
}

TEST(SimulatedHand, OnlyASimulatedSubjectIsOne) {
  const experiment::CompiledExperiment experiment(experiment::readExperiment("chain-slow"));
  EXPECT_THROW(prepareSubjects(experiment, "mouse"), FaultError);
  EXPECT_THROW(prepareSubjects(experiment, "simulated:kind=robot"), FaultError);
  std::shared_ptr<void> learnt;
  EXPECT_EQ(prepareSubjects(experiment, "simulated")(1, 0, learnt)->info().name, "simulated");
  EXPECT_EQ(prepareSubjects(experiment, "simulated")(1, 0, learnt)->info().version, "1");
  EXPECT_EQ(learnt, nullptr) << "it learns nothing";
  (void)prepareSubjects(experiment, "simulated:kind=ofc")(1, 0, learnt);
  EXPECT_NE(learnt, nullptr);
}

// Noise alone, over 60 trials: along the way and across, its part of the speed has the asked SD, and the three are of one size.
TEST(SimulatedHand, ItsSpeedIsNoisyInProportionAlongAndAcross) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  const auto noisy = devices::makeDevice("simulated:time-sd=0,reaction=0.001,speed-sd=0.1", experiment, 4);
  const auto plain = devices::makeDevice("simulated:noise=0,time-sd=0,reaction=0.001", experiment, 4);
  const auto meant = motionOf(*plain, 0);
  Vec3 squares;
  double count = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto moved = motionOf(*noisy, trial);
    for (std::size_t i = 101; i < 1200; i += 7) {
      const double by = norm(meant[i] - meant[i - 1]);
      const Vec3 off = (moved[i] - moved[i - 1] - (meant[i] - meant[i - 1])) / by;
      squares += Vec3{off.x * off.x, off.y * off.y, off.z * off.z};
      ++count;
    }
  }
  // Some six independent values a trial and axis: a standard error of 4 % of the SD.
  for (const double sum : {squares.x, squares.y, squares.z}) EXPECT_NEAR(std::sqrt(sum / count), 0.1, 0.016);
}

// 15 % of the reaction time, with noise of 1 or more alike; without noise it is the same in each trial.
TEST(SimulatedHand, ItsReactionVaries) {
  const experiment::Experiment experiment = experiment::readExperiment("chain-moderate");
  const auto reactions = [&](const std::string& options) {
    const auto device = devices::makeDevice("simulated:speed-sd=0,time-sd=0,reaction=0.4" + options, experiment, 9);
    double sum = 0, squares = 0;
    constexpr int kTrials = 150;
    for (int trial = 0; trial < kTrials; ++trial) {
      const auto motion = motionOf(*device, trial);
      std::size_t at = 0;
      while (motion[at + 1] == motion[0]) ++at;
      const double t = 1e-3 * static_cast<double>(at);
      sum += t, squares += t * t;
    }
    return std::pair{sum / kTrials, std::sqrt(std::max(squares / kTrials - sum * sum / kTrials / kTrials, 0.0))};
  };
  for (const char* noise : {"", ",noise=4"}) {
    const auto [mean, sd] = reactions(noise);
    EXPECT_NEAR(mean, 0.4, 0.02) << noise;
    EXPECT_NEAR(sd, 0.06, 0.014) << noise;
  }
  EXPECT_NEAR(reactions(",noise=0.5").second, 0.03, 0.007);
  const auto [still, none] = reactions(",noise=0");
  EXPECT_NEAR(still, 0.4, 0.002);
  EXPECT_NEAR(none, 0, 1e-9);
}

}  // namespace
}  // namespace reachlab::subjects
