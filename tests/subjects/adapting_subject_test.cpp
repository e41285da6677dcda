// A virtual subject that feels forces on its hand, or sees a cursor beside it, and learns from trial to trial.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/task_plane.h"
#include "sim/subjects/environment_learner.h"
#include "sim/subjects/subject_kinds.h"
#include "tests/bare_reach.h"
#include "tests/refusal.h"
#include "tests/subjects/conducted.h"

namespace reachlab::subjects {
namespace {

using namespace experiment;

constexpr double kB = 13;  // [N s/m]

Experiment sensedReach() {
  Experiment e = bareReach();
  e.task->tolerance = {0.01, 0.05, 0.3};
  e.velocityEstimator.kind = "device";
  return e;
}
Experiment inCurl() {
  Experiment e = sensedReach();
  e.environment = {{curl(kB)}};
  return e;
}
Experiment inChannel() {
  Experiment e = sensedReach();
  ChannelForce wall;
  wall.stiffness = 6000;  // as that of Smith et al. 2006
  wall.damping = 100;
  e.environment = {{wall, ForceWhen::Trial}};
  return e;
}
Experiment rotated(double degrees) {
  Experiment e = sensedReach();
  e.cursor.emplace();
  e.cursor->rotation = degrees;
  return e;
}

struct Seen {
  double deviation = 0;  // [m] to the right, where it is largest
  double angle = 0;      // [degrees] of the hand at its largest speed, counterclockwise
  double pressed = 0;    // share of the force that would cancel the field, as the wall returns it
  trial::TrialResult result;
};

/// A person without noise, in one world after another.
class Person {
 public:
  explicit Person(std::string kind = "kind=ofc,noise=0") : device_("simulated:" + std::move(kind)) {}

  Seen reach(const Experiment& world) {
    const CompiledExperiment compiled(world);
    const auto hand = prepareSubjects(compiled, device_)(1, 1, learnt_);
    haptics::TickEngine engine(compiled, haptics::engineOptions(*hand));
    hand->prepareTrial(trial_++);
    const haptics::TickState& state = engine.state();
    Seen seen;
    double fastest = 0, product = 0, ideal = 0;
    reachTickByTick(engine, *hand, [&](const haptics::DeviceSample&, std::optional<haptics::Cue>) {
      if (state.phase != trial::Phase::Moving) return true;
      const Vec3 at = state.hands[0].hip.position, v = state.hands[0].hip.velocity;
      if (std::abs(at.x) > std::abs(seen.deviation)) seen.deviation = at.x;
      if (norm(v) > fastest) {
        fastest = norm(v);
        seen.angle = std::atan2(-at.x, -at.z) * 180 / 3.14159265358979323846;
      }
      const double wanted = kB * v.z;  // to the right, of the field, while the hand goes forward at -v.z
      product += state.environment.force.x * wanted;
      ideal += wanted * wanted;
      return true;
    });
    seen.result = state.result;
    seen.pressed = product / ideal;
    hand->prepareTrial(trial_);  // learns from it
    return seen;
  }

 private:
  std::string device_;
  std::shared_ptr<void> learnt_;
  int trial_ = 0;
};

TEST(AdaptingSubject, IsPushedAsideByACurlFieldAndLearnsToCancelIt) {
  Person person;
  const double straight = person.reach(sensedReach()).deviation;
  EXPECT_NEAR(straight, 0, 1e-6);
  const double first = person.reach(inCurl()).deviation;
  EXPECT_LT(first, -0.005) << "forward is pushed to the left by this field";
  double before = first;
  for (int i = 0; i < 60; ++i) {
    const double now = person.reach(inCurl()).deviation;
    if (i % 10 != 9) continue;
    EXPECT_LT(std::abs(now), std::abs(before) + 1e-4) << i;
    before = now;
  }
  EXPECT_LT(std::abs(before), 0.5 * std::abs(first));
  const double after = person.reach(sensedReach()).deviation;
  EXPECT_GT(after, 0.25 * std::abs(first)) << "an after-effect to the other side";
  for (int i = 0; i < 60; ++i) person.reach(sensedReach());
  EXPECT_LT(std::abs(person.reach(sensedReach()).deviation), 0.2 * after) << "and it is washed out";
}

TEST(AdaptingSubject, ShowsTheAfterEffectWithAnObjectInTheHandToo) {
  const auto holding = [](Experiment e) {
    e.object.kind = experiment::ObjectKind::Point;
    e.object.masses = {0.6};
    e.coupling = {600, 5};
    return e;
  };
  Person person;
  EXPECT_NEAR(person.reach(holding(sensedReach())).deviation, 0, 1e-6);
  for (int i = 0; i < 40; ++i) person.reach(holding(inCurl()));
  const double after = person.reach(holding(sensedReach())).deviation;
  EXPECT_GT(after, 1e-3);
  for (int i = 0; i < 60; ++i) person.reach(holding(sensedReach()));
  EXPECT_LT(std::abs(person.reach(holding(sensedReach())).deviation), 0.3 * after);
}

TEST(AdaptingSubject, PressesAgainstAChannelWithWhatItHasLearned) {
  Person person;
  EXPECT_NEAR(person.reach(inChannel()).pressed, 0, 0.01);
  double before = 0;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 25; ++k) person.reach(inCurl());
    const double now = person.reach(inChannel()).pressed;
    EXPECT_GT(now, before);
    before = now;
  }
  // Two states in equilibrium, x = 0.75 of the field (Smith et al. 2006), through a wall that yields and an arm that holds back 5 %.
  EXPECT_GT(before, 0.55);
  EXPECT_LT(before, 0.85);
}

TEST(AdaptingSubject, TurnsItsAimAgainstARotatedCursor) {
  Person person;
  const Seen first = person.reach(rotated(30));
  EXPECT_NEAR(first.angle, 0, 0.5);
  EXPECT_EQ(first.result.outcome, trial::Outcome::Failure) << "the cursor does not come to the target";
  for (int i = 0; i < 80; ++i) person.reach(rotated(30));
  const double learned = person.reach(rotated(30)).angle;
  EXPECT_LT(learned, -18);
  EXPECT_GT(learned, -30);
  const double after = person.reach(rotated(0)).angle;
  EXPECT_LT(after, -10) << "the after-effect has the sign of what was learned";
}

TEST(AdaptingSubject, AnImpedanceFeelsTheFieldAndDoesNotLearn) {
  Person person("kind=impedance,noise=0");
  const double first = person.reach(inCurl()).deviation;
  EXPECT_LT(first, -0.003);
  for (int i = 0; i < 5; ++i) person.reach(inCurl());
  EXPECT_NEAR(person.reach(inCurl()).deviation, first, 1e-12);
  EXPECT_EQ(Person("kind=impedance,noise=0").reach(sensedReach()).result.outcome, trial::Outcome::Success);
}

TEST(AdaptingSubject, APlanIsRefusedWhereAForcePushesAndPlayedInAChannel) {
  const auto refusal = [](const Experiment& e) {
    return refusalOf([&] { prepareSubjects(CompiledExperiment(e), "simulated:kind=plan"); });
  };
  EXPECT_TRUE(holds(refusal(inCurl()), "environment[0] cannot push it aside"));
  EXPECT_EQ(refusal(inChannel()), "");
  EXPECT_EQ(refusal(sensedReach()), "");
  EXPECT_EQ(Person("kind=plan,noise=0").reach(inChannel()).result.outcome, trial::Outcome::Success);
}

// One state in equilibrium under a constant error: x = B e / (1 - A).
TEST(EnvironmentLearner, KeepsAndLearnsAsItsTwoProcessesSay) {
  LearntEnvironment learnt;
  const LearningRates rates{0.21, 0.59, 0.02, 0.992};
  for (int i = 0; i < 5000; ++i) learn(rates, {1, -2, 3}, learnt);
  EXPECT_NEAR(learnt.fast.along, 0.21 / 0.41, 1e-12);
  EXPECT_NEAR(learnt.slow.along, 0.02 / 0.008, 1e-9);
  EXPECT_NEAR(learnt.current().across, -2 * (0.21 / 0.41 + 0.02 / 0.008), 1e-9);
  EXPECT_NEAR(learnt.current().angle, 3 * (0.21 / 0.41 + 0.02 / 0.008), 1e-9);
}

TEST(EnvironmentLearner, AnErrorIsTheCoefficientOfTheForceAndTheAngleAtTheLargestSpeed) {
  EnvironmentTrace trace;
  for (int i = 1; i <= 10; ++i) {
    const double speed = 0.05 * (i < 6 ? i : 11 - i);
    trace.add(2 * speed, -13 * speed, speed);
    trace.look(10.0 * i, speed);
  }
  const EnvironmentModel error = trace.error();
  EXPECT_NEAR(error.along, 2, 1e-12);
  EXPECT_NEAR(error.across, -13, 1e-12);
  EXPECT_EQ(error.angle, 50);
  EXPECT_EQ(EnvironmentTrace{}.error().across, 0);
}

}  // namespace
}  // namespace reachlab::subjects
