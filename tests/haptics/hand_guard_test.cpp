#include "sim/haptics/hand_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "sim/haptics/tick_order.h"
#include "tests/haptics/armed_at_once.h"

namespace reachlab::haptics {
namespace {

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

TEST(Wall, PushesAlongTheRayFromItsCentre) {
  GuardSettings settings{.wallCentre = {0.01, -0.02, 0.03}, .wallRadius = 0.1, .wallStiffness = 700, .wallDamping = 3, .compensation = {}};
  const Vec3 outwards{2.0 / 7, -3.0 / 7, 6.0 / 7}, place = settings.wallCentre + 0.105 * outwards;
  const Vec3 along = wallForce(settings, place, 0.4 * outwards + Vec3{3, 2, 0});  // the second part is along the wall
  EXPECT_LT(norm(along + (700 * 0.005 + 3 * 0.4) * outwards), 1e-9);
  EXPECT_LT(norm(wallForce(settings, place, -0.4 * outwards) + 700 * 0.005 * outwards), 1e-9);
  EXPECT_EQ(wallForce(settings, settings.wallCentre + 0.0999 * outwards, outwards), Vec3{});
  EXPECT_EQ(wallForce(GuardSettings{}, {5, 0, 0}, {}), Vec3{}) << "no wall was asked for";
  settings.wallRadius = 0.5;  // narrower than a metre, and a wall all the same
  EXPECT_NEAR(norm(wallForce(settings, settings.wallCentre + Vec3{0, 0.51, 0}, {})), 7, 1e-9);
}

TEST(GuardSettings, AreEqualWhereEveryOneIs) {
  const GuardSettings settings;
  EXPECT_TRUE(settings == GuardSettings{});
  for (const auto& change : std::vector<std::function<void(GuardSettings&)>>{
           [](GuardSettings& s) { s.wallCentre.y = 1; }, [](GuardSettings& s) { s.wallRadius = 1; },
           [](GuardSettings& s) { s.wallStiffness = 1; }, [](GuardSettings& s) { s.wallDamping = 1; },
           [](GuardSettings& s) { s.compensation.z = 1; }, [](GuardSettings& s) { s.passivityControl = true; }}) {
    GuardSettings other;
    change(other);
    EXPECT_FALSE(settings == other);
  }
}

TEST(PassivityObserver, CountsTheWorkOnTheHeldForceAlongEveryAxis) {
  PassivityObserver port;
  port.render({100, 100, 100});
  port.observe({1, 2, 3});
  EXPECT_EQ(port.energy(), 0) << "the first place is no way";
  port.render({2, -3, 5});
  port.observe({1.5, 2.25, 2.875});
  EXPECT_NEAR(port.energy(), -(2 * 0.5 - 3 * 0.25 - 5 * 0.125), 1e-15);
  port.render({-1, 4, 0});
  port.observe({1, 2, 3});
  EXPECT_NEAR(port.energy(), 0.375 - (1 * 0.5 - 4 * 0.25), 1e-15);
  port.reset();
  EXPECT_EQ(port.energy(), 0);
  port.observe({7, 7, 7});
  EXPECT_EQ(port.energy(), 0);
}

// alpha = -E/(T v^2), held to 5 N s/m; a hand slower than 1 mm/s takes no energy, and nothing is taken back that was not given.
TEST(PassivityObserver, TheControllerBrakesByTheEnergyThatIsMissing) {
  const auto owing = [](double joules) {
    PassivityObserver port;
    port.observe({});
    port.render({joules, 0, 0});
    port.observe({1, 0, 0});
    return port;
  };
  const Vec3 velocity{0.3, 0, -0.4};
  const Vec3 some = owing(1e-3).control(velocity), most = owing(1e-2).control(velocity);
  EXPECT_LT(norm(some + 1e-3 / (1e-3 * 0.25) * velocity), 1e-12);
  EXPECT_LT(norm(most + 5 * velocity), 1e-12);
  EXPECT_LT(norm(owing(1e-2).control({0, 1.01e-3, 0}) + 5 * Vec3{0, 1.01e-3, 0}), 1e-12);
  EXPECT_EQ(owing(1e-2).control({0, 0.99e-3, 0}), Vec3{});
  EXPECT_EQ(owing(-1e-2).control(velocity), Vec3{});
  EXPECT_EQ(owing(0).control(velocity), Vec3{});
}

class GuardedEngine : public ::testing::Test {
 protected:
  GuardedEngine() : experiment(test::armedAtOnce("chain-slow")) { options.hands[0].rendersForce = true; }
  // At the start with a trial put up, until it is armed and the ramp is over.
  TickEngine& armed() {
    engine = std::make_unique<TickEngine>(experiment, options);
    tick({-0.1, 0, 0}, trial::Command::NextTrial);
    for (int i = 0; i < 300; ++i) tick({-0.1, 0, 0});
    return *engine;
  }
  const TickState& tick(const Vec3& place, trial::Command command = trial::Command::None, bool fault = false) {
    TickInput input;
    input.devices[0].position = place;
    input.devices[0].valid = !fault;
    input.deviceFault = fault;
    input.command = command;
    runTick(*engine, input);
    return engine->state();
  }
  experiment::Experiment experiment;
  EngineOptions options;
  std::unique_ptr<TickEngine> engine;
};

TEST_F(GuardedEngine, TheWallIsFeltBesideTheObjectAndSaid) {
  options.hands[0].guards.wallRadius = 0.099;
  armed();
  const TickState& state = tick({-0.1, 0, 0});
  EXPECT_NEAR(state.hands[0].deviceForce.x, 500 * 0.001, 1e-9) << "1 mm into it";
  EXPECT_TRUE(state.hands[0].interventions & intervention::kWall);
  EXPECT_FALSE(state.hands[0].clamped) << "the device gets what it was asked for";
}

TEST_F(GuardedEngine, TheStylusIsHeldAlsoBetweenTrials) {
  options.hands[0].guards.compensation = {0, 0.295 * 9.80665, 0};
  engine = std::make_unique<TickEngine>(experiment, options);
  for (int i = 0; i < 300; ++i) tick({0.05, 0, 0});
  EXPECT_EQ(engine->state().hands[0].deviceForce, options.hands[0].guards.compensation);
  EXPECT_EQ(tick({0.05, 0, 0}, trial::Command::None, true).hands[0].deviceForce, Vec3{}) << "a fault takes it as well";
}

TEST_F(GuardedEngine, StatesFollowTheTrial) {
  engine = std::make_unique<TickEngine>(experiment, options);
  EXPECT_EQ(engine->state().hands[0].deviceState, DeviceState::Off);
  EXPECT_EQ(tick({0, 0, 0}).hands[0].deviceState, DeviceState::Homed);
  EXPECT_EQ(tick({0, 0, 0}, trial::Command::NextTrial).hands[0].deviceState, DeviceState::Armed);
  for (int i = 0; i < 5; ++i) tick({-0.1, 0, 0});
  EXPECT_EQ(engine->state().hands[0].deviceState, DeviceState::Engaged);
  EXPECT_EQ(tick({-0.1, 0, 0}, trial::Command::None, true).hands[0].deviceState, DeviceState::Fault);
}

// What the observer counts is what the device was given, without the weight that is held beside it.
TEST_F(GuardedEngine, TheWeightOfAStylusIsNoEnergyOfTheProgram) {
  options.hands[0].guards.compensation = {0, 2, 0};
  engine = std::make_unique<TickEngine>(experiment, options);
  for (int i = 0; i < 300; ++i) tick({0.05, 0, 0});
  for (int i = 1; i <= 100; ++i) tick({0.05, 1e-4 * i, 0});
  EXPECT_NEAR(engine->state().hands[0].portEnergy, 0, 1e-15);
  EXPECT_EQ(engine->state().hands[0].interventions, 0);
  EXPECT_FALSE(engine->state().hands[0].clamped);
}

// Pulled out by 3 cm and back, at 600 N/m on a chain of 3 kg: the energy that is counted is the work on the forces that were given.
TEST_F(GuardedEngine, ThePortsEnergyIsTheWorkOnTheForceThatWasFelt) {
  armed();
  double work = 0;
  Vec3 place{-0.1, 0, 0}, force = engine->state().hands[0].deviceForce;
  for (int i = 0; i <= 600; ++i) {
    const Vec3 next{-0.1 + 0.03 * std::sin(0.01 * i), 1e-5 * i, 0};
    work -= dot(force, next - place);
    place = next;
    const TickState& state = tick(next);
    ASSERT_NEAR(state.hands[0].portEnergy, work, 1e-12) << i;
    force = state.hands[0].deviceForce;
  }
  EXPECT_GT(std::abs(work), 1e-3);
  tick(place, trial::Command::Abort);
  tick(place, trial::Command::NextTrial);
  EXPECT_EQ(engine->state().hands[0].portEnergy, 0) << "each trial counts for itself";
}

// The mass of 3 kg swings on its coupling without a damper: held from tick to tick, the coupling gives energy away.
TEST_F(GuardedEngine, ThePassivityControllerActsWhereItIsWantedAlone) {
  for (const bool wanted : {false, true}) {
    options.hands[0].guards.passivityControl = wanted;
    armed();
    int acted = 0;
    double least = 0;
    for (int i = 0; i <= 1500; ++i) {
      const TickState& state = tick({-0.1 + 0.01 * std::sin(0.09 * i), 0, 0});
      if (state.hands[0].interventions & intervention::kPassivity) {
        ++acted;
        EXPECT_LT(state.hands[0].portEnergy, 0);
        EXPECT_LT(dot(state.hands[0].deviceForce - state.hands[0].feedbackForce, state.hands[0].hip.velocity), 0) << "it brakes";
      }
      least = std::min(least, state.hands[0].portEnergy);
    }
    if (wanted) {
      EXPECT_GT(acted, 10);
    } else {
      EXPECT_EQ(acted, 0);
    }
    EXPECT_LT(least, 0);
  }
}

TEST_F(GuardedEngine, AReleasedHandIsHomedAndALostOneOff) {
  engine = std::make_unique<TickEngine>(experiment, options);
  TickInput input;
  input.devices[0].position = {0.05, 0, 0};
  input.devices[0].valid = false;
  runTick(*engine, input);
  EXPECT_EQ(engine->state().hands[0].deviceState, DeviceState::Off);
  input.devices[0].released = true;
  runTick(*engine, input);
  EXPECT_EQ(engine->state().hands[0].deviceState, DeviceState::Homed);
  input.devices[0] = {};
  input.devices[0].position = {0.05, std::nan(""), 0};
  runTick(*engine, input);
  EXPECT_EQ(engine->state().hands[0].deviceState, DeviceState::Homed) << "no force was computed from it";
}

}  // namespace
}  // namespace reachlab::haptics
