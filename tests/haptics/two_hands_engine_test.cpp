// The engine of a tick with two hands on one object.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sim/haptics/tick_order.h"
#include "tests/haptics/armed_at_once.h"
#include "tests/refusal.h"

namespace reachlab::haptics {
namespace {

// The chain that two hands hold by its ends.
class TwoHands : public ::testing::Test {
 protected:
  TwoHands() { make(); }
  void make() {
    experiment = test::armedPatiently("chain-two-hands");
    change(experiment);
    engine = std::make_unique<TickEngine>(experiment, EngineOptions{{{}, second}});
    putAtStart();
  }
  void putAtStart() {
    hands = {};
    hands[0].position = hands[1].position = engine->protocol().start;
  }
  const TickState& tick(trial::Command command = trial::Command::None) {
    TickInput input;
    input.command = command;
    std::copy(hands.begin(), hands.end(), input.devices.begin());
    runTick(*engine, input);
    return engine->state();
  }
  void arm() {
    tick(trial::Command::NextTrial);
    tick();
    ASSERT_EQ(engine->state().phase, trial::Phase::Armed);
    for (int i = 0; i < 250; ++i) tick();  // until the ramps are over
  }
  std::function<void(experiment::Experiment&)> change = [](experiment::Experiment&) {};
  DeviceInfo second{.maxForce = 5};
  experiment::Experiment experiment;
  std::unique_ptr<TickEngine> engine;
  std::array<DeviceSample, 2> hands;
};

TEST_F(TwoHands, EachFeelsItsOwnEndWithinItsOwnLimit) {
  arm();
  for (int i = 0; i < 50; ++i) {
    hands[0].position.x += 2e-4;
    hands[1].position.x -= 4e-4;
    const TickState& state = tick();
    EXPECT_EQ(state.handCount, 2);
    EXPECT_EQ(state.hands[0].feedbackForce, -state.hands[0].couplingForce);
    EXPECT_EQ(state.hands[1].feedbackForce, -state.hands[1].couplingForce);
  }
  const TickState& state = engine->state();
  // 600 N/m between each hand and its end, which is where the mass is.
  EXPECT_NEAR(state.hands[0].couplingForce.x, 600 * (state.hands[0].hip.position.x - state.masses[0].r.x), 1e-9);
  EXPECT_NEAR(state.hands[1].couplingForce.x, 600 * (state.hands[1].hip.position.x - state.masses[4].r.x), 1e-9);
  for (int i = 0; i < 100; ++i) {
    hands[1].position.x -= 4e-4;
    tick();
  }
  EXPECT_NEAR(norm(engine->state().hands[1].deviceForce), 5, 1e-9);
  EXPECT_TRUE(engine->state().hands[1].clamped);
  EXPECT_FALSE(engine->state().hands[0].clamped);
  EXPECT_GT(engine->state().faults.clampedTicks, 10u) << "of either hand";
}

// What both hands have done is in the object, and in the springs between it and them.
TEST_F(TwoHands, TheirWorkIsTheEnergyTheyGave) {
  arm();
  for (int i = 0; i < 400; ++i) {
    hands[0].position.x += 1e-4 * std::sin(0.01 * i);
    hands[1].position.x += 3e-5 * std::sin(0.02 * i);
    tick();
  }
  const TickState& state = engine->state();
  EXPECT_GT(std::abs(state.hands[0].work), 1e-4);
  EXPECT_GT(std::abs(state.hands[1].work), 1e-5);
  EXPECT_NE(state.hands[0].work, state.hands[1].work);
  double kinetic = 0, elastic = 0;
  for (int m = 0; m < 5; ++m) kinetic += 0.3 * dot(state.masses[m].v, state.masses[m].v);
  for (int m = 0; m < 4; ++m) elastic += 300 * std::pow(state.masses[m + 1].r.x - state.masses[m].r.x, 2);
  EXPECT_NEAR(state.hands[0].work + state.hands[1].work, kinetic + elastic, 2e-3 * (kinetic + elastic)) << "trapezoids of a tick";
}

TEST_F(TwoHands, BothAreWaitedForAtTheStart) {
  hands[1].position.x += 0.05;
  tick(trial::Command::NextTrial);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(tick().phase, trial::Phase::Waiting);
  hands[1].position.x -= 0.045;
  EXPECT_EQ(tick().phase, trial::Phase::Armed);
  EXPECT_EQ(engine->state().hands[1].couplingForce, Vec3{}) << "held where it is seen";
  EXPECT_EQ(engine->state().hands[1].hip.position, engine->state().masses[4].r);
}

TEST_F(TwoHands, BothMustBeAtRestAtTheStart) {
  change = [](experiment::Experiment& e) { e.task->rest = {0.01, 0.005}; };
  make();
  tick(trial::Command::NextTrial);
  for (int i = 0; i < 100; ++i) {
    hands[1].position.y = 2e-5 * i;  // 20 mm/s
    EXPECT_EQ(tick().phase, trial::Phase::Waiting) << i;
  }
  for (int i = 0; i < 100; ++i) tick();
  EXPECT_EQ(engine->state().phase, trial::Phase::Armed);
}

// Lost, or given as no number: one hand takes the force from both, and ends the trial for both.
TEST_F(TwoHands, OneThatIsLostTakesTheForceFromBoth) {
  for (const bool noNumber : {false, true}) {
    make();
    arm();
    for (int i = 0; i < 50; ++i) {
      hands[0].position.x += 1e-4;
      hands[1].position.x -= 1e-4;
      tick();
    }
    ASSERT_NE(engine->state().hands[0].deviceForce, Vec3{});
    if (noNumber) hands[1].position.x = std::numeric_limits<double>::quiet_NaN();
    else hands[1].valid = false;
    const TickState& state = tick();
    EXPECT_EQ(state.hands[0].deviceForce, Vec3{}) << noNumber;
    EXPECT_EQ(state.hands[1].deviceForce, Vec3{});
    EXPECT_EQ(state.hands[0].couplingForce, Vec3{});
    EXPECT_EQ(state.hands[1].couplingForce, Vec3{});
    EXPECT_EQ(state.status, dynamics::StepStatus::HandLost);
    EXPECT_EQ(state.hands[0].deviceState, noNumber ? DeviceState::Homed : DeviceState::Engaged);
    for (int i = 0; i < trial::kLostTicks; ++i) tick();
    EXPECT_EQ(state.phase, trial::Phase::Done);
    EXPECT_EQ(state.result.reason, trial::Reason::DeviceLost);
  }
}

TEST_F(TwoHands, TheForceLimitOfEitherMayEndTheTrial) {
  for (const std::size_t who : {0, 1}) {
    change = [](experiment::Experiment& e) { e.forceLimit = 1, e.forceLimitEndsTrial = true; };
    make();
    arm();
    for (int i = 0; i < 100; ++i) {
      hands[who].position.x += 1e-4;
      tick();
    }
    EXPECT_EQ(engine->state().result.reason, trial::Reason::ForceLimit) << who;
  }
}

TEST_F(TwoHands, TheNextTrialOfBothBeginsLikeTheFirst) {
  std::vector<Vec3> first, again;
  for (auto* forces : {&first, &again}) {
    putAtStart();
    hands[1].position.y = forces == &first ? 0 : 0.004;  // beside the start: held there
    arm();
    for (int i = 0; i < 100; ++i) {
      hands[1].position.x += 1e-4;
      tick();
      forces->push_back(engine->state().hands[1].couplingForce);
    }
    tick(trial::Command::Abort);
  }
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_LT(norm(first[i] - again[i]), 1e-9) << i;
}

TEST_F(TwoHands, AreWithoutAPersonOnlyIfBothAre) {
  for (const bool one : {false, true})
    for (const bool other : {false, true}) {
      const EngineOptions options{{{.virtualHand = one}, {.virtualHand = other}}};
      EXPECT_EQ(TickEngine(experiment, options).protocol().startTimeoutTicks == trial::kNoLimit, !(one && other));
    }
}

TEST_F(TwoHands, TheSecondDeviceMayRenderForceByItself) {
  second.rendersForce = true;
  make();
  EXPECT_FALSE(engine->state().hands[0].rendersForce);
  EXPECT_TRUE(engine->state().hands[1].rendersForce);
  TickEngine other(experiment, EngineOptions{{{.rendersForce = true}, {}}});
  EXPECT_TRUE(other.state().hands[0].rendersForce);
  EXPECT_FALSE(other.state().hands[1].rendersForce);
}

TEST(TickEngine, RefusesOtherThanADeviceForEachHand) {
  const auto refusal = [](const char* name, std::size_t hands) -> std::string {
    return refusalOf([&] { TickEngine engine(test::armedAtOnce(name), EngineOptions{std::vector<DeviceInfo>(hands)}); });
  };
  EXPECT_TRUE(holds(refusal("chain-two-hands", 1), "is 1 device where the experiment has 2 hands"));
  EXPECT_EQ(refusal("chain-two-hands", 2), "");
  EXPECT_TRUE(holds(refusal("chain-two-hands", 3), "is 3 devices where the experiment has 2 hands"));
  EXPECT_TRUE(holds(refusal("chain-slow", 2), "is 2 devices where the experiment has 1 hand;"));
}

}  // namespace
}  // namespace reachlab::haptics
