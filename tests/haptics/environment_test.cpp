// Forces on the hand and a cursor, as the engine of a tick exerts and judges them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/math/minimum_jerk.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/tick_order.h"
#include "tests/bare_reach.h"
#include "tests/haptics/armed_at_once.h"

namespace reachlab::haptics {
namespace {

using namespace experiment;

constexpr double kForceLimit = 12;  // [N]

Cursor cursorOf(double rotation, double gain = 1, CursorJudge judge = CursorJudge::Cursor) {
  return {.rotation = rotation, .gain = gain, .clamp = {}, .judge = judge};
}

Experiment judgedReach() {
  Experiment e = bareReach();
  e.task->tolerance = {0.005, 0.05, 0.2};
  e.task->rest = kNoStartRest;
  e.velocityEstimator.kind = "difference";
  e.timing = kNoTimingLimits;
  return e;
}

class Reach {
 public:
  explicit Reach(const Experiment& e)
      : engine(e, EngineOptions{{{.maxForce = kForceLimit, .virtualHand = true, .rendersForce = true}}}), hand(engine.protocol().start) {}

  const TickState& tick(trial::Command command = trial::Command::None) {
    TickInput input;
    input.devices[0].position = hand;
    input.command = command;
    runTick(engine, input);
    return engine.state();
  }
  void arm() {
    tick(trial::Command::NextTrial);
    tick();
    ASSERT_EQ(engine.state().phase, trial::Phase::Armed);
  }
  /// A minimum-jerk reach by `way` in 0.5 s, and then rest until the trial has ended. `look` sees each state.
  template <class Look>
  void reach(const Vec3& way, Look&& look) {
    const Vec3 from = hand;
    for (int i = 1; i <= 1200 && engine.state().phase != trial::Phase::Done; ++i) {
      hand = from + minimumJerk(std::min(1.0, i / 500.0)) * way;
      look(tick());
    }
  }
  void reach(const Vec3& way) {
    reach(way, [](const TickState&) {});
  }

  TickEngine engine;
  Vec3 hand;
};

TEST(EngineEnvironment, AddsTheForceOfTheLawToThatOfTheObject) {
  Experiment e = test::armedPatiently("chain-moderate");
  e.environment = {{curl(13)}};
  Reach with(e);
  e.environment.clear();
  Reach without(e);
  with.arm(), without.arm();
  int moving = 0;
  for (int i = 1; i <= 300; ++i) {
    with.hand.x += 3e-4;
    without.hand.x += 3e-4;
    const TickState &a = with.tick(), &b = without.tick();
    ASSERT_EQ(a.hands[0].couplingForce, b.hands[0].couplingForce) << "the object does not feel it";
    ASSERT_FALSE(b.hasEnvironment);
    EXPECT_EQ(a.hands[0].feedbackForce, a.environment.force - a.hands[0].couplingForce);
    if (a.phase != trial::Phase::Moving) continue;
    const double grown = std::min(1.0, moving++ / 20.0);  // it begins at onset and is whole after 20 ms
    const Vec3 v = a.hands[0].hip.velocity;
    ASSERT_NEAR(norm(a.environment.force - grown * 13 * Vec3{v.z, 0, -v.x}), 0, 1e-12) << i;
  }
  EXPECT_GT(moving, 200);
}

TEST(EngineEnvironment, MovementBeginsAtOnsetAndTrialAtArming) {
  for (const ForceWhen when : {ForceWhen::Movement, ForceWhen::Trial}) {
    Experiment e = judgedReach();
    e.environment = {{ElasticForce{{{{100, 0, 0}, {0, 100, 0}, {0, 0, 100}}}, Vec3{0.01, 0, 0}}, when}};
    Reach run(e);
    run.arm();
    for (int i = 0; i < 50; ++i) run.tick();
    const Vec3 still = run.engine.state().environment.force;
    EXPECT_NEAR(norm(still - (when == ForceWhen::Movement ? Vec3{} : Vec3{1, 0, 0})), 0, 1e-12);
    run.hand.z -= 0.002;
    for (int i = 0; i < 30; ++i) run.tick();
    ASSERT_EQ(run.engine.state().phase, trial::Phase::Moving);
    EXPECT_NEAR(norm(run.engine.state().environment.force - Vec3{1, 0, 0.2}), 0, 1e-12);
  }
}

TEST(EngineEnvironment, ItsForceObeysTheLimitAndTheSlewOfTheSafetyLayer) {
  Experiment e = judgedReach();
  e.environment = {{curl(200)}, {PulseForce{{0, 8, 0}, {0.1, std::nullopt}, 0.1, 1e-3}}};
  Reach run(e);
  run.arm();
  Vec3 last;
  double most = 0, asked = 0;
  run.reach({0, 0, -0.1}, [&](const TickState& state) {
    const Vec3 force = state.hands[0].deviceForce;
    EXPECT_LE(norm(force), kForceLimit * (1 + 1e-12));
    if (norm(force) > 0) {
      EXPECT_LE(norm(force - last), ForceSafety::kSlewPerTick * (1 + 1e-12));
    }
    last = force;
    most = std::max(most, norm(force));
    asked = std::max(asked, norm(state.hands[0].feedbackForce));
  });
  EXPECT_GT(asked, 3 * kForceLimit);
  EXPECT_NEAR(most, kForceLimit, 1e-9);
}

TEST(EngineEnvironment, AChannelThatIsLeftIsMarkedUntilTheNextTrial) {
  Experiment e = judgedReach();
  e.environment = {{ChannelForce{}, ForceWhen::Trial}};
  Reach run(e);
  run.arm();
  run.reach({0.04, 0, -0.1});
  EXPECT_TRUE(run.engine.state().environment.channelBroken);
  EXPECT_EQ(run.engine.state().environment.force, Vec3{}) << "it has let go";
  run.hand = run.engine.protocol().start;
  run.arm();
  EXPECT_FALSE(run.engine.state().environment.channelBroken);
  run.reach({0.004, 0, -0.1});
  EXPECT_FALSE(run.engine.state().environment.channelBroken);
}

TEST(EngineEnvironment, AForceThatIsNotFiniteEndsInZeroForceAndAbortsTheTrial) {
  Experiment e = judgedReach();
  e.arm.shoulder = {0, -0.55};
  e.environment = {{JointViscousForce{{{{1.66, 0.64}, {0.64, -1.54}}}}}};
  Reach run(e);
  run.arm();
  bool beyond = false;
  run.reach({0, 0, -0.1}, [&](const TickState& state) {  // the arm of 0.6 m is stretched after 5 cm
    beyond = beyond || !isFinite(state.environment.force);
    if (!isFinite(state.environment.force)) {
      EXPECT_EQ(state.hands[0].deviceForce, Vec3{});
    }
  });
  EXPECT_TRUE(beyond);
  EXPECT_EQ(run.engine.state().result.reason, trial::Reason::Computation);
}

TEST(BareHand, StartsTheTrialIsSeenWhereItIsAndIsJudged) {
  Reach run(judgedReach());
  run.hand += Vec3{0.003, 0.002, -0.004};
  run.arm();
  EXPECT_EQ(run.engine.state().hands[0].hip.position, run.hand) << "there is no object that the hand would be put on";
  EXPECT_EQ(run.engine.state().masses[0].r, run.hand);
  run.reach(Vec3{0, 0, -0.1} - run.hand);
  EXPECT_EQ(run.engine.state().result.outcome, trial::Outcome::Success);
  EXPECT_EQ(run.engine.state().hands[0].deviceForce, Vec3{});
}

TEST(BareHand, ThatMissesIsToldByHowMuchAndWithoutAMass) {
  Reach run(judgedReach());
  run.arm();
  run.reach({0.008, 0, -0.1});
  const trial::TrialResult& result = run.engine.state().result;
  EXPECT_EQ(result.reason, trial::Reason::Position);
  EXPECT_NEAR(result.by, 0.003, 1e-12);
  EXPECT_EQ(result.mass, 0);
}

TEST(JudgedCursor, IsBroughtToTheTargetByTheHandThatUndoesItsRotation) {
  const double angle = -30 * 3.14159265358979323846 / 180;
  const Vec3 turned = 0.1 * Vec3{-std::sin(angle), 0, -std::cos(angle)};  // forward, turned by -30 degrees as seen from above
  const auto outcomeOf = [](const Cursor& cursor, const Vec3& way) {
    Experiment e = judgedReach();
    e.cursor = cursor;
    Reach run(e);
    run.arm();
    run.reach(way);
    return run.engine.state().result.outcome;
  };
  EXPECT_EQ(outcomeOf(cursorOf(30), turned), trial::Outcome::Success);
  EXPECT_EQ(outcomeOf(cursorOf(30), {0, 0, -0.1}), trial::Outcome::Failure);
  EXPECT_EQ(outcomeOf(cursorOf(30, 1, CursorJudge::Hand), {0, 0, -0.1}), trial::Outcome::Success);
  EXPECT_EQ(outcomeOf(cursorOf(0, 2), {0, 0, -0.05}), trial::Outcome::Success);
}

TEST(JudgedCursor, IsKnownInEveryTick) {
  Experiment e = judgedReach();
  e.cursor = cursorOf(0, 2);
  Reach run(e);
  run.hand = {0.3, 0, 0.2};
  run.tick(trial::Command::NextTrial);
  EXPECT_EQ(run.tick().environment.cursor, (Vec3{0.6, 0, 0.4})) << "also on the way to the start";
  EXPECT_EQ(run.engine.state().masses[0].r, (Vec3{0.6, 0, 0.4})) << "the point that the subject sees";
}

}  // namespace
}  // namespace reachlab::haptics
