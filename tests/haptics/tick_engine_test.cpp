#include "sim/haptics/tick_engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/fault.h"
#include "tests/haptics/armed_at_once.h"

namespace reachlab::haptics {
namespace {

constexpr double kLimit = 12;  // [N]

DeviceSample handAt(const Vec3& position) {
  DeviceSample sample;
  sample.position = position;
  return sample;
}

// chain-moderate, whose movements may have gaps, so that what a gap does can be seen to its end.
experiment::Experiment chainThatMayMissTime() {
  experiment::Experiment experiment = test::armedAtOnce("chain-moderate");
  experiment.timing = experiment::kNoTimingLimits;
  return experiment;
}

// With a hand that is put where the test wants it.
class Engine : public ::testing::Test {
 protected:
  explicit Engine(bool virtualHand = false)
      : experiment(chainThatMayMissTime()), engine(experiment, {kLimit, virtualHand}), hand(engine.protocol().start) {}

  const TickState& tick(trial::Command command = trial::Command::None, std::uint32_t missed = 0) {
    TickInput input;
    input.device = handAt(hand);
    input.command = command;
    input.missedTicks = missed;
    engine.tick(input);
    return engine.state();
  }
  void arm() {
    tick(trial::Command::NextTrial);
    tick();
    ASSERT_EQ(engine.state().phase, trial::Phase::Armed);
  }
  // A hand on its way at 0.2 m/s.
  void move(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      hand.x += 2e-4;
      tick();
    }
  }
  Vec3 massOne() const { return engine.state().masses[0].r; }

  experiment::Experiment experiment;
  TickEngine engine;
  Vec3 hand;
};
class VirtualHandEngine : public Engine {
 protected:
  VirtualHandEngine() : Engine(true) {}
};

TEST_F(Engine, RestsAtTheStartWithoutForceUntilArmed) {
  hand.y += 0.05;
  tick(trial::Command::NextTrial);
  for (int i = 0; i < 50; ++i) {
    const TickState& state = tick();
    ASSERT_EQ(state.phase, trial::Phase::Waiting);
    EXPECT_EQ(state.deviceForce, Vec3{});
    EXPECT_EQ(state.couplingForce, Vec3{});
    for (int m = 0; m < state.massCount; ++m) EXPECT_EQ(norm(state.masses[m].v), 0);
  }
}

TEST_F(Engine, PlacesTheFixedPointOnTheHandAtArming) {
  const Vec3 offset{0.004, -0.005, 0.006};
  hand += offset;
  arm();
  EXPECT_EQ(engine.state().couplingForce, Vec3{});
  EXPECT_EQ(engine.state().hand.position, massOne());
  hand.x += 5e-4;
  const TickState& state = tick();
  EXPECT_NEAR(norm(state.couplingForce), 600 * 5e-4, 1e-3) << "k_h times the hand's way; the mass has hardly moved in one tick";
}

TEST_F(Engine, TheDeviceFeelsTheOppositeOfTheObject) {
  arm();
  for (int i = 0; i < 400; ++i) {
    hand.x += 2e-4;
    const TickState& state = tick();
    EXPECT_EQ(state.feedbackForce + state.couplingForce, Vec3{});
    EXPECT_LE(norm(state.deviceForce), kLimit);
  }
  EXPECT_EQ(engine.state().deviceForce, engine.state().feedbackForce) << "within the limits nothing is changed";
}

TEST_F(Engine, TellsAVirtualHandWhenToBeWhere) {
  tick(trial::Command::NextTrial);
  EXPECT_EQ(engine.cue(), Cue::Place);
  tick();
  EXPECT_EQ(engine.cue(), Cue::Go);
  tick();
  EXPECT_EQ(engine.cue(), std::nullopt);
}

TEST_F(Engine, GivesTheGoSignalAfterTheForeperiod) {
  TickInput input;
  input.device = handAt(hand);
  input.command = trial::Command::NextTrial;
  input.planned.foreperiodTicks = 3;
  engine.tick(input);
  tick();
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(engine.cue(), std::nullopt);
    tick();
  }
  EXPECT_EQ(engine.cue(), Cue::Go);
}

TEST_F(Engine, ForcesAreZeroAsSoonAsTheTrialHasEnded) {
  arm();
  move(300);
  ASSERT_GT(norm(engine.state().deviceForce), 0);
  const TickState& state = tick(trial::Command::Abort);
  EXPECT_EQ(state.phase, trial::Phase::Done);
  EXPECT_EQ(state.deviceForce, Vec3{});
  EXPECT_EQ(state.couplingForce, Vec3{});
  const Vec3 where = massOne();
  move(20);
  EXPECT_EQ(massOne(), where);
}

TEST_F(Engine, TheNextTrialBeginsLikeTheFirst) {
  const auto run = [this] {
    hand = engine.protocol().start;
    tick(trial::Command::NextTrial);
    tick();
    move(500);
    const TickState& state = engine.state();
    std::vector<double> numbers{state.couplingForce.x, state.energy};
    for (int m = 0; m < state.massCount; ++m)
      numbers.insert(numbers.end(), {state.masses[m].r.x, state.masses[m].v.x, state.masses[m].a.x});
    tick(trial::Command::Abort);
    return numbers;
  };
  const auto first = run();
  EXPECT_EQ(first, run());
}

TEST_F(Engine, AHandThatIsNotANumberGivesZeroForceAndEndsTheTrial) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    hand = engine.protocol().start;
    arm();
    move(300);
    const Vec3 good = hand, mass = massOne();
    hand.z = bad;
    tick();
    EXPECT_EQ(engine.state().deviceForce, Vec3{});
    EXPECT_EQ(engine.state().phase, trial::Phase::Done);
    EXPECT_EQ(engine.state().result.reason, trial::Reason::DeviceLost);
    EXPECT_EQ(massOne(), mass);
    hand = good;
    for (int i = 0; i < 500; ++i) EXPECT_EQ(tick().deviceForce, Vec3{});
    EXPECT_TRUE(isFinite(engine.state().hand.position));
  }
}

TEST_F(Engine, ALostHandGivesZeroForceAndComesBackWithoutAJump) {
  arm();
  move(300);
  const double before = engine.state().couplingForce.x;
  TickInput lost;
  lost.device = handAt(hand);
  lost.device.valid = false;
  for (int i = 0; i < 10; ++i) {
    engine.tick(lost);
    EXPECT_EQ(engine.state().deviceForce, Vec3{});
    EXPECT_EQ(engine.state().status, dynamics::StepStatus::HandLost);
  }
  hand.x += 0.003;
  const TickState& back = tick();
  EXPECT_EQ(back.phase, trial::Phase::Moving);
  EXPECT_NEAR(back.couplingForce.x, before, 0.2) << "3 mm at 600 N/m at once would be 1.8 N; mass 1 moves on by 0.2 mm";
}

// 125 ms during which the hand went on at 0.2 m/s: 2.5 cm in one tick, 15 N at once if it were believed.
TEST_F(Engine, ALongGapGivesNeitherABurstNorAJump) {
  arm();
  move(300);
  Vec3 mass = massOne(), force = engine.state().couplingForce;
  hand.x += 0.025;
  tick(trial::Command::None, 124);
  EXPECT_EQ(engine.state().deviceForce, Vec3{}) << "the tick after a gap renders nothing";
  Vec3 deviceForce;
  double mostForce = 0, mostMass = 0, mostDevice = 0;
  for (int i = 0; i < 600; ++i) {
    const TickState& state = i == 0 ? engine.state() : tick();
    mostForce = std::max(mostForce, norm(state.couplingForce - force));
    mostMass = std::max(mostMass, norm(massOne() - mass));
    mostDevice = std::max(mostDevice, norm(state.deviceForce - deviceForce));
    force = state.couplingForce;
    mass = massOne();
    deviceForce = state.deviceForce;
  }
  // While the gap is blended out the hand moves by at most 1.875 * 2.5 cm / 250 ms more than before.
  EXPECT_LT(mostForce, 0.25);
  EXPECT_LT(mostMass, 1.2e-3);
  EXPECT_LE(mostDevice, ForceSafety::kSlewPerTick);
  EXPECT_NEAR(engine.state().hand.position.x, hand.x, 1e-12) << "seen where it is, once the blend is over";
  EXPECT_EQ(engine.state().faults.missedTicks, 124u);
}

TEST_F(VirtualHandEngine, AGapChangesNothingForAHandThatMovesByTickCount) {
  TickEngine other(experiment, {kLimit, true});
  const auto both = [&](trial::Command command, std::uint32_t missed) {
    TickInput input;
    input.device = handAt(hand);
    input.command = command;
    other.tick(input);
    input.missedTicks = missed;
    engine.tick(input);
    for (int m = 0; m < 5; ++m) ASSERT_EQ(engine.state().masses[m].r, other.state().masses[m].r);
    ASSERT_EQ(engine.state().couplingForce, other.state().couplingForce);
  };
  both(trial::Command::NextTrial, 0);
  both(trial::Command::None, 0);
  for (int i = 0; i < 800; ++i) {
    hand.x += 2e-4;
    both(trial::Command::None, i % 100 == 50 ? 130 : 0);
  }
  EXPECT_EQ(engine.state().tick, 802u) << "one tick a tick, whatever the clock did";
}

// The object feels what the hand did; the device is spared the kick.
TEST_F(Engine, AJumpOfTenCentimetresStaysFiniteAndWithinTheLimits) {
  arm();
  move(100);
  hand.x += 0.1;
  Vec3 last = engine.state().deviceForce;
  for (int i = 0; i < 300; ++i) {
    const TickState& state = tick();
    ASSERT_TRUE(isFinite(state.couplingForce));
    EXPECT_LE(norm(state.deviceForce), kLimit * (1 + 1e-12));
    EXPECT_LE(norm(state.deviceForce - last), ForceSafety::kSlewPerTick * (1 + 1e-12));
    last = state.deviceForce;
  }
  EXPECT_GT(engine.state().faults.clampedTicks, 0u);
  // Momentum: five masses of 0.6 kg cannot have gained more than 60 N (k_h times the jump) for 0.3 s.
  for (int m = 0; m < 5; ++m) EXPECT_LT(norm(engine.state().masses[m].v), 60 * 0.3 / 0.6);
}

TEST_F(Engine, TheEnergyOfTheObjectIsTheWorkOfTheHand) {
  arm();
  double work = 0;
  Vec3 hip = engine.state().hand.position, force;
  for (int i = 0; i < 800; ++i) {
    hand.x += 2e-4 * std::sin(i * 3.14159265358979 / 800);
    const TickState& state = tick();
    work += dot(0.5 * (force + state.couplingForce), state.hand.position - hip);
    force = state.couplingForce;
    hip = state.hand.position;
  }
  // Trapezoid of a force that swings at up to 60 rad/s: relative error (60 * 1e-3)^2/12 = 3e-4.
  EXPECT_NEAR(engine.state().energy, work, 5e-4 * work);
}

// A chain of 40 gives its 40 masses by 1600 products, its first and last by 80.
TEST(TickEngine, SeesEveryMassOfALongChainWhereItIsNeeded) {
  constexpr int kMasses = 40, kEvery = 10, kReach = 1350;
  experiment::Experiment experiment = test::armedAtOnce("chain-moderate");
  experiment.object.masses.assign(kMasses, 3.0 / kMasses);
  experiment.object.stiffness.assign(kMasses - 1, 600.0 * kMasses / 5);
  experiment.object.damping.assign(kMasses - 1, 0);
  experiment.task->tolerance.position = 0.02;  // so wide that it arrives, the middle masses last
  experiment.task->tolerance.velocity = 0.3;
  TickEngine all(experiment, {}), seldom(experiment, {});
  seldom.setMassesEvery(kEvery);
  const Vec3 from = all.protocol().start, way = all.protocol().target - from;
  TickInput input;
  int unseen = 0;
  for (int i = 0; i < 2 * kReach && all.state().phase != trial::Phase::Done; ++i) {
    const double x = std::min(1.0, i / double{kReach});
    input.device = handAt(from + (x * x * x * (10 + x * (6 * x - 15))) * way);
    input.command = i == 0 ? trial::Command::NextTrial : trial::Command::None;
    all.tick(input);
    seldom.tick(input);
    const TickState &a = all.state(), &b = seldom.state();
    ASSERT_EQ(a.phase, b.phase) << i;
    ASSERT_EQ(a.couplingForce, b.couplingForce) << i;
    ASSERT_EQ(a.deviceForce, b.deviceForce) << i;
    for (const int m : {0, kMasses - 1}) {
      ASSERT_EQ(a.masses[m].r, b.masses[m].r) << i;
      ASSERT_EQ(a.masses[m].v, b.masses[m].v) << i;
      ASSERT_EQ(a.masses[m].q, b.masses[m].q) << i;
    }
    if (a.tick % kEvery == 0) {
      ASSERT_TRUE(seldom.sawAllMasses()) << "a row is due";
    }
    if (!seldom.sawAllMasses()) {
      ++unseen;
      continue;
    }
    ASSERT_EQ(a.energy, b.energy) << i;
    for (int m = 0; m < kMasses; ++m) ASSERT_EQ(a.masses[m].r, b.masses[m].r) << i;
  }
  EXPECT_EQ(all.state().phase, trial::Phase::Done);
  EXPECT_EQ(all.state().result.outcome, trial::Outcome::Success);
  EXPECT_NE(all.state().result.endTick % kEvery, 0u) << "the verdict is to fall on a tick at which no row is due";
  EXPECT_EQ(all.state().result.endTick, seldom.state().result.endTick);
  EXPECT_TRUE(seldom.sawAllMasses());
  EXPECT_GT(unseen, kReach / 2);
}

// A study looks at no tick, or at those of which a recording would keep a row.
TEST(TickEngine, JudgesTheSameWhereNobodyLooks) {
  int successes = 0;
  for (const char* name : {"chain-moderate", "parallel", "free-point"}) {
    experiment::Experiment experiment = test::armedAtOnce(name);
    experiment.task->tolerance.position = 0.02;  // so wide that it arrives
    experiment.task->tolerance.velocity = 0.3;
    TickEngine all(experiment, {}), seldom(experiment, {}), never(experiment, {});
    constexpr int kEvery = 10, kReach = 1500;
    seldom.setLookedAtEvery(kEvery);
    never.setLookedAtEvery(0);
    const Vec3 from = all.protocol().start, way = all.protocol().target - from;
    TickInput input;
    int unseen = 0;
    for (int trial = 0; trial < 2; ++trial) {
      for (int i = 0; i < 2 * kReach && (i == 0 || all.state().phase != trial::Phase::Done); ++i) {
        const double x = std::min(1.0, i / double{kReach});
        input.device = handAt(from + (x * x * x * (10 + x * (6 * x - 15))) * way);
        input.command = i == 0 ? trial::Command::NextTrial : trial::Command::None;
        for (TickEngine* engine : {&all, &seldom, &never}) engine->tick(input);
        const TickState& a = all.state();
        for (const TickEngine* engine : {&seldom, &never}) {
          const TickState& b = engine->state();
          ASSERT_EQ(a.phase, b.phase) << name << i;
          ASSERT_EQ(a.couplingForce, b.couplingForce) << name << i;
          ASSERT_EQ(a.deviceForce, b.deviceForce) << name << i;
          for (const int m : {0, a.massCount - 1}) {
            ASSERT_EQ(a.masses[m].r, b.masses[m].r) << name << i;
            ASSERT_EQ(a.masses[m].v, b.masses[m].v) << name << i;
          }
          if (!engine->sawAllMasses()) continue;
          ASSERT_EQ(a.energy, b.energy) << name << i;
          for (int m = 0; m < a.massCount; ++m) ASSERT_EQ(a.masses[m].a, b.masses[m].a) << name << i;
        }
        if (a.tick % kEvery == 0) ASSERT_TRUE(seldom.sawAllMasses()) << "a row is due";
        if (!never.sawAllMasses()) ++unseen;
      }
      if (all.state().result.outcome == trial::Outcome::Success) ++successes;
      EXPECT_EQ(all.state().result.reason, never.state().result.reason) << name;
      EXPECT_EQ(all.state().result.by, never.state().result.by) << name;
      EXPECT_EQ(all.state().result.mass, never.state().result.mass) << name;
      EXPECT_EQ(all.state().result.endTick, never.state().result.endTick) << name;
      EXPECT_TRUE(never.sawAllMasses()) << "as a trial ended";
    }
    EXPECT_GT(unseen, kReach) << name;
  }
  EXPECT_GT(successes, 0);
  EXPECT_LT(successes, 6) << "both verdicts are to be seen";
}

TEST(TickEngine, AnotherEngineGoesOnWithTheScene) {
  const auto compiled = experiment::CompiledExperiment(test::armedAtOnce("chain-moderate"));
  TickEngine fresh(compiled, {}), first(compiled, {});
  TickInput input;
  const auto at = [](int i) { return handAt({-0.1 + (i > 10 ? 5e-5 * (i - 10) : 0), 0, 0}); };
  for (int i = 0; i < 900; ++i) {
    input.device = at(i);
    input.command = i == 1 ? trial::Command::NextTrial : trial::Command::None;
    first.tick(input);
  }
  TickEngine again(compiled.experiment(), std::move(first).takeScene(), {});
  for (int i = 0; i < 900; ++i) {
    input.device = at(i);
    input.command = i == 1 ? trial::Command::NextTrial : trial::Command::None;
    fresh.tick(input);
    again.tick(input);
    ASSERT_EQ(fresh.state().couplingForce, again.state().couplingForce) << i;
    ASSERT_EQ(fresh.state().masses[4].r, again.state().masses[4].r) << i;
  }
  EXPECT_NE(fresh.state().couplingForce, Vec3{});
}

TEST(TickEngine, TheSameInputsGiveTheSameBits) {
  const experiment::Experiment experiment = test::armedAtOnce("parallel");
  TickEngine one(experiment, {}), two(experiment, {});
  TickInput input;
  for (int i = 0; i < 1500; ++i) {
    input.device = handAt({-0.1 + (i > 10 ? 5e-5 * (i - 10) : 0), 1e-4 * std::sin(0.1 * i), 0});
    input.command = i == 1 ? trial::Command::NextTrial : trial::Command::None;
    one.tick(input);
    two.tick(input);
    ASSERT_EQ(std::memcmp(&one.state().masses, &two.state().masses, sizeof(dynamics::MassState) * 2), 0);
    ASSERT_EQ(one.state().couplingForce, two.state().couplingForce);
  }
}

TEST(TickEngine, ABodyHeldOffItsCentreIsArmedWithoutForce) {
  const experiment::Experiment experiment = test::armedAtOnce("free-body");
  ASSERT_GT(norm(experiment.object.fpOffset), 0.01);
  TickEngine engine(experiment, {});
  TickInput input;
  input.device = handAt(engine.protocol().start);
  input.command = trial::Command::NextTrial;
  for (int i = 0; i < 20; ++i) {
    engine.tick(input);
    input.command = trial::Command::None;
    EXPECT_LT(norm(engine.state().couplingForce), 1e-12) << "rounding of the place, times 600 N/m";
  }
  EXPECT_EQ(engine.state().phase, trial::Phase::Armed);
}

TEST(TickEngine, RefusesAnExperimentWithoutATask) {
  experiment::Experiment experiment = test::armedAtOnce("chain-moderate");
  experiment.task.reset();
  EXPECT_THROW(TickEngine(experiment, {}), FaultError);
}

TEST(TickEngine, AForceLimitOfTheExperimentWinsOverTheDevices) {
  experiment::Experiment experiment = test::armedAtOnce("chain-moderate");
  experiment.forceLimit = 1;
  experiment.forceLimitEndsTrial = true;
  TickEngine engine(experiment, {kLimit, false});
  TickInput input;
  input.device = handAt(engine.protocol().start);
  input.command = trial::Command::NextTrial;
  for (int i = 0; i < 2000 && engine.state().phase != trial::Phase::Done; ++i) {
    engine.tick(input);
    EXPECT_LE(norm(engine.state().deviceForce), 1 + 1e-12);
    input.command = trial::Command::None;
    input.device.position.x += 2e-4;
  }
  EXPECT_EQ(engine.state().result.reason, trial::Reason::ForceLimit);
}

// The hand is frozen ahead of the object: the coupling asks for more than the device's 12 N and goes on asking.
double mostForceOnAFrozenHand(double experimentsLimit, bool rendersForce) {
  experiment::Experiment experiment = test::armedAtOnce("chain-moderate");
  experiment.forceLimit = experimentsLimit;
  EngineOptions options{kLimit};
  options.rendersForce = rendersForce;
  TickEngine engine(experiment, options);
  TickInput input;
  input.device = handAt(engine.protocol().start);
  double most = 0, asked = 0;
  for (int i = 0; i < 1500; ++i) {
    input.command = i == 0 ? trial::Command::NextTrial : trial::Command::None;
    if (i > 10 && i < 260) input.device.position.x += 4e-4;
    engine.tick(input);
    most = std::max(most, norm(engine.state().deviceForce));
    asked = std::max(asked, norm(engine.state().feedbackForce));
  }
  EXPECT_GT(asked, 13.2);
  return most;
}

TEST(TickEngine, AnExperimentCannotRaiseTheLimitOfADeviceThatRendersForce) {
  EXPECT_NEAR(mostForceOnAFrozenHand(20, true), kLimit, 1e-12);
  EXPECT_NEAR(mostForceOnAFrozenHand(5, true), 5, 1e-12);
  EXPECT_GT(mostForceOnAFrozenHand(20, false), 13.2) << "where no force is felt, the experiment's stands for the device's";
}

}  // namespace
}  // namespace reachlab::haptics
