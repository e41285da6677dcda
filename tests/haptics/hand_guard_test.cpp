#include "sim/haptics/hand_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "sim/haptics/tick_engine.h"
#include "tests/haptics/armed_at_once.h"

namespace reachlab::haptics {
namespace {

TEST(Wall, PushesInwardsByItsLawAndNotWithin) {
  GuardSettings settings;
  settings.wallCentre = {0.01, 0, 0};
  settings.wallRadius = 0.1;
  EXPECT_EQ(wallForce(settings, {0.11, 0, 0}, {1, 0, 0}), Vec3{});
  const Vec3 outwards = wallForce(settings, {0.112, 0, 0}, {0.5, 3, 0});
  EXPECT_NEAR(outwards.x, -(500 * 0.002 + 2 * 0.5), 1e-9);
  EXPECT_EQ(outwards.y, 0);
  EXPECT_NEAR(wallForce(settings, {0.112, 0, 0}, {-0.5, 0, 0}).x, -500 * 0.002, 1e-9) << "it does not hold back who leaves it";
  settings.wallRadius = 0;
  EXPECT_EQ(wallForce(settings, {5, 0, 0}, {}), Vec3{}) << "no wall was asked for";
}

// A spring held from tick to tick gives more than it takes: over a cycle of period P at 1 kHz, E = -(k A^2 pi) sin-lag, to first order
// -pi k A^2 w dt/2. The observer must see exactly that.
TEST(PassivityObserver, SeesTheEnergyThatASampledSpringGivesAway) {
  constexpr double k = 600, amplitude = 0.01, w = 2 * M_PI * 5, dt = 1e-3;
  PassivityObserver port;
  for (int i = 0; i <= 200; ++i) {
    const double x = amplitude * std::sin(w * i * dt);
    port.observe({x, 0, 0});
    port.render({-k * x, 0, 0});
  }
  const double expected = -M_PI * k * amplitude * amplitude * w * dt / 2;
  EXPECT_NEAR(port.energy(), expected, 1e-3 * std::abs(expected)) << "the law to first order in w dt = 0.03";
}

TEST(PassivityObserver, TheControllerTakesItBack) {
  constexpr double k = 600, amplitude = 0.01, w = 2 * M_PI * 5, dt = 1e-3;
  double controlled = 0, left = 0;
  for (const bool control : {true, false}) {
    PassivityObserver port;
    for (int i = 0; i <= 2000; ++i) {
      const double x = amplitude * std::sin(w * i * dt), v = amplitude * w * std::cos(w * i * dt);
      port.observe({x, 0, 0});
      const Vec3 dissipation = control ? port.control({v, 0, 0}) : Vec3{};
      EXPECT_LE(norm(dissipation), PassivityObserver::kMaxDissipation * std::abs(v) + 1e-12);
      port.render(Vec3{-k * x, 0, 0} + dissipation);
    }
    (control ? controlled : left) = port.energy();
  }
  EXPECT_LT(left, -0.02);
  EXPECT_GT(controlled, 0.1 * left) << "what is left is less than a cycle's";
}

TEST(PassivityObserver, APassiveDamperIsLeftAlone) {
  PassivityObserver port;
  for (int i = 0; i <= 500; ++i) {
    const double v = std::cos(0.02 * i);
    port.observe({1e-3 * 50 * std::sin(0.02 * i), 0, 0});
    EXPECT_EQ(port.control({v, 0, 0}), Vec3{}) << i;
    port.render({-2 * v, 0, 0});
  }
  EXPECT_GT(port.energy(), 0);
}

class GuardedEngine : public ::testing::Test {
 protected:
  GuardedEngine() : experiment(test::armedAtOnce("chain-slow")) { options.rendersForce = true; }
  // At the start with a trial put up, until it is armed and the ramp is over.
  TickEngine& armed() {
    engine = std::make_unique<TickEngine>(experiment, options);
    tick({-0.1, 0, 0}, trial::Command::NextTrial);
    for (int i = 0; i < 300; ++i) tick({-0.1, 0, 0});
    return *engine;
  }
  const TickState& tick(const Vec3& place, trial::Command command = trial::Command::None, bool fault = false) {
    TickInput input;
    input.device.position = place;
    input.device.valid = !fault;
    input.deviceFault = fault;
    input.command = command;
    engine->tick(input);
    return engine->state();
  }
  experiment::Experiment experiment;
  EngineOptions options;
  std::unique_ptr<TickEngine> engine;
};

TEST_F(GuardedEngine, TheWallIsFeltBesideTheObjectAndSaid) {
  options.guards.wallRadius = 0.099;
  armed();
  const TickState& state = tick({-0.1, 0, 0});
  EXPECT_NEAR(state.deviceForce.x, 500 * 0.001, 1e-9) << "1 mm into it";
  EXPECT_TRUE(state.interventions & intervention::kWall);
  EXPECT_FALSE(state.clamped) << "the device gets what it was asked for";
}

TEST_F(GuardedEngine, TheStylusIsHeldAlsoBetweenTrials) {
  options.guards.compensation = {0, 0.295 * 9.80665, 0};
  engine = std::make_unique<TickEngine>(experiment, options);
  for (int i = 0; i < 300; ++i) tick({0.05, 0, 0});
  EXPECT_EQ(engine->state().deviceForce, options.guards.compensation);
  EXPECT_EQ(tick({0.05, 0, 0}, trial::Command::None, true).deviceForce, Vec3{}) << "a fault takes it as well";
}

TEST_F(GuardedEngine, StatesFollowTheTrial) {
  engine = std::make_unique<TickEngine>(experiment, options);
  EXPECT_EQ(engine->state().deviceState, DeviceState::Off);
  EXPECT_EQ(tick({0, 0, 0}).deviceState, DeviceState::Homed);
  EXPECT_EQ(tick({0, 0, 0}, trial::Command::NextTrial).deviceState, DeviceState::Armed);
  for (int i = 0; i < 5; ++i) tick({-0.1, 0, 0});
  EXPECT_EQ(engine->state().deviceState, DeviceState::Engaged);
  EXPECT_EQ(tick({-0.1, 0, 0}, trial::Command::None, true).deviceState, DeviceState::Fault);
}

TEST_F(GuardedEngine, NothingAskedForChangesNoBit) {
  TickEngine plain(experiment, EngineOptions{});
  options = {};
  options.guards.wallRadius = 10;
  armed();
  TickInput first;
  first.device.position = {-0.1, 0, 0};
  first.command = trial::Command::NextTrial;
  plain.tick(first);
  first.command = trial::Command::None;
  for (int i = 0; i < 300; ++i) plain.tick(first);
  for (int i = 0; i < 500; ++i) {
    first.device.position.x = -0.1 + 1e-4 * i;
    plain.tick(first);
    tick(first.device.position);
    ASSERT_EQ(plain.state().deviceForce, engine->state().deviceForce) << i;
  }
}

TEST(ForceSafetyInterventions, EachIsSaidWhenItActs) {
  ForceSafety safety({5, 0, 10});
  safety.limit({1, 0, 0}, true, true);
  EXPECT_TRUE(safety.interventions() & intervention::kRamp);
  for (int i = 0; i < 300; ++i) safety.limit({1, 0, 0}, true, true);
  EXPECT_EQ(safety.interventions(), 0);
  safety.limit({4.5, 0, 0}, true, true);
  EXPECT_EQ(safety.interventions(), intervention::kSlew);
  for (int i = 0; i < 5; ++i) safety.limit({9, 0, 0}, true, true);
  EXPECT_EQ(safety.interventions(), intervention::kLimit);
  safety.limit({9, 0, 0}, true, false);
  EXPECT_EQ(safety.interventions(), intervention::kHeldBack);
  safety.limit({NAN, 0, 0}, true, true);
  EXPECT_EQ(safety.interventions(), intervention::kNotFinite);
  ForceSafety warm({5, 1, 0.1});
  for (int i = 0; i < 1000; ++i) warm.limit({4, 0, 0}, true, true);
  EXPECT_EQ(warm.interventions(), intervention::kHeat);
}

}  // namespace
}  // namespace reachlab::haptics
