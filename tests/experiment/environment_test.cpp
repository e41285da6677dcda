#include "sim/experiment/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/describe.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/task_plane.h"
#include "tests/refusal.h"

namespace reachlab::experiment {
namespace {

/// A free reach of a bare hand, with these further keys.
std::string reachWith(const std::string& keys) {
  return R"({ "schema_version": 1, "constraint": { "name": "free" }, "object": { "kind": "none" },
  "task": { "start": [0, 0, 0], "target": [0, 0, -0.1], "duration_s": 0.5,
            "tolerance": { "position_m": 0.01, "velocity_m_per_s": 0.05, "time_s": 0.2 } }, )" +
         keys + " }";
}
Experiment read(const std::string& keys) { return parseExperiment(reachWith(keys), "x.json"); }
std::string refused(const std::string& keys) {
  return refusalOf([&] { read(keys); });
}

TEST(EnvironmentKeys, ReadEveryKindOfForce) {
  const Experiment e = read(R"("environment": [
    { "kind": "viscous", "matrix_n_s_per_m": [[0, 0, 13], [0, 0, 0], [-13, 0, 0]] },
    { "kind": "elastic", "matrix_n_per_m": [[100, 0, 0], [0, 0, 0], [0, 0, 50]], "centre_m": [0, 0, -0.05], "when": "trial" },
    { "kind": "joint-viscous", "matrix_n_m_s_per_rad": [[1.66, 0.64], [0.64, -1.54]] },
    { "kind": "channel", "stiffness_n_per_m": 2000 },
    { "kind": "pulse", "force_n": [5, 0, 0], "at": { "distance_m": 0.02 }, "duration_s": 0.05 }])");
  ASSERT_EQ(e.environment.size(), 5u);
  EXPECT_EQ(e.environment[0], (HandForce{ViscousForce{{{{0, 0, 13}, {0, 0, 0}, {-13, 0, 0}}}}}));
  EXPECT_EQ(e.environment[1], (HandForce{ElasticForce{{{{100, 0, 0}, {0, 0, 0}, {0, 0, 50}}}, Vec3{0, 0, -0.05}}, ForceWhen::Trial}));
  EXPECT_EQ(e.environment[2], (HandForce{JointViscousForce{{{{1.66, 0.64}, {0.64, -1.54}}}}}));
  EXPECT_EQ(e.environment[3], (HandForce{ChannelForce{.stiffness = 2000}, ForceWhen::Trial})) << "a channel acts from arming";
  EXPECT_EQ(e.environment[4], (HandForce{PulseForce{{5, 0, 0}, {std::nullopt, 0.02}, 0.05}}));
  Experiment again = parseExperiment(toJson(e), "x.json");
  again.text = e.text;
  EXPECT_EQ(again, e);
  EXPECT_TRUE(holds(describe(e), "a viscous field of [0 0 13; 0 0 0; -13 0 0] N s/m"));
}

TEST(EnvironmentKeys, NoForceIsAnEmptyListOrNoKey) {
  EXPECT_TRUE(read(R"("environment": [])").environment.empty());
  EXPECT_TRUE(read(R"("hand_mass_kg": 1)").environment.empty());
}

// Each of these was fine, and each trial then ended as a fault of the computation, or without a wall.
TEST(EnvironmentKeys, RefuseForcesThatNoTrialCouldFeel) {
  const auto joint = [](const std::string& arm) {
    return refused(R"("environment": [{ "kind": "joint-viscous", "matrix_n_m_s_per_rad": [[1, 0], [0, 1]] }], "arm": )" + arm);
  };
  EXPECT_EQ(joint(R"({ "shoulder_m": [0, -0.49] })"), "") << "0.59 m to the target";
  EXPECT_TRUE(holds(joint(R"({ "shoulder_m": [0, -0.5] })"), "target is 0.6 m from the arm's shoulder")) << "stretched";
  EXPECT_TRUE(holds(joint(R"({ "shoulder_m": [3, 4] })"), "start is 5 m from the arm's shoulder"));
  EXPECT_TRUE(holds(joint(R"({ "shoulder_m": [0, 0], "link_length_m": [0.3, 0.3] })"), "start is 0 m")) << "folded";
  EXPECT_TRUE(holds(joint(R"({ "shoulder_m": [0, 0.05], "link_length_m": [0.3, 0.29] })"), "the way to the target is")) << "folded between";
  const auto channel = [](const std::string& keys) { return refused(R"("environment": [{ "kind": "channel", )" + keys + " }]"); };
  EXPECT_EQ(channel(R"("half_width_m": 0.01)"), "");
  EXPECT_TRUE(holds(channel(R"("half_width_m": 0.01, "break_m": 0.01)"), "environment[0].break_m: is 0.01"));
  EXPECT_TRUE(holds(channel(R"("half_width_m": 0.05)"), "more than 0.05 m"));
}

TEST(EnvironmentKeys, RefuseMoreForcesThanAServoCycleHasTimeFor) {
  std::string forces = R"({ "kind": "channel" })";
  for (int i = 1; i < 100; ++i) forces += R"(, { "kind": "channel" })";
  EXPECT_EQ(refused(R"("environment": [)" + forces + "]"), "");
  EXPECT_TRUE(holds(refused(R"("environment": [)" + forces + R"(, { "kind": "channel" }])"), "environment: has 101 forces"));
}

TEST(EnvironmentKeys, RefuseWhatIsNoForceUnderItsKey) {
  const auto told = [](const std::string& force) { return refused(R"("environment": [ )" + force + " ]"); };
  EXPECT_TRUE(holds(refused(R"("environment": { "kind": "channel" })"), "environment: is"));
  EXPECT_TRUE(holds(told("{}"), "environment[0].kind"));
  EXPECT_TRUE(holds(told(R"({ "kind": "magnetic" })"), "environment[0].kind: is \"magnetic\""));
  EXPECT_TRUE(holds(told(R"({ "kind": "viscous" })"), "environment[0].matrix_n_s_per_m: is missing"));
  const std::string rows = told(R"({ "kind": "viscous", "matrix_n_s_per_m": [[1, 2], [3, 4]] })");
  EXPECT_TRUE(holds(rows, "environment[0].matrix_n_s_per_m: has 2 rows"));
  EXPECT_TRUE(holds(told(R"({ "kind": "viscous", "matrix_n_s_per_m": [13, 13, 13] })"), "matrix_n_s_per_m[0]: is"))
      << "a list of three numbers is no matrix here";
  const std::string large = told(R"({ "kind": "viscous", "matrix_n_s_per_m": [[1, 0, 0], [0, 1e300, 0], [0, 0, 1]] })");
  EXPECT_TRUE(holds(large, "matrix_n_s_per_m[1][1]: is 1e+300"));
  EXPECT_TRUE(holds(told(R"({ "kind": "channel", "matrix_n_s_per_m": [[0, 0, 0], [0, 0, 0], [0, 0, 0]] })"), "matrix_n_s_per_m"))
      << "the key of another law is unknown";
  EXPECT_TRUE(holds(told(R"({ "kind": "channel", "stiffness_n_per_m": 0 })"), "stiffness_n_per_m: is 0"));
  EXPECT_TRUE(holds(told(R"({ "kind": "pulse", "force_n": [1, 0, 0], "at": {}, "when": "trial" })"), "when")) << "a pulse has its instant";
  EXPECT_TRUE(holds(told(R"({ "kind": "pulse", "force_n": [1, 0, 0], "at": {} })"), "exactly one of onset_s and distance_m"));
  EXPECT_TRUE(holds(told(R"({ "kind": "pulse", "force_n": [1, 0, 0], "at": { "onset_s": 0 }, "duration_s": 0.01 })"), "shorter than rise"));
}

TEST(EnvironmentKeys, AChannelNeedsALine) {
  Experiment still = read(R"("environment": [ { "kind": "channel" } ])"), lap = readExperiment("ellipse");
  still.task->target = still.task->start;
  lap.environment = still.environment;
  EXPECT_TRUE(check(lap).faults.empty());
  lap.task->target[0] = lap.task->start[0] + 2 * std::numbers::pi;
  for (const Experiment& e : {still, lap}) EXPECT_EQ(keysTold(check(e).faults), "environment[0].kind");
}

TEST(EnvironmentKeys, AFieldThatIsNotFiniteIsRefused) {
  Experiment e = read(R"("environment": [ { "kind": "viscous", "matrix_n_s_per_m": [[1, 0, 0], [0, 1, 0], [0, 0, 1]] } ])");
  std::get<ViscousForce>(e.environment[0].law).matrix[2][0] = std::nan("");
  EXPECT_EQ(keysTold(check(e).faults), "environment[0].matrix_n_s_per_m[2][0]");
}

TEST(EnvironmentKeys, ActOnOneHandOnly) {
  Experiment e = readExperiment("chain-moderate");
  e.environment = {{ChannelForce{}}};
  e.task->target[0] = e.task->start[0] + 1;
  EXPECT_TRUE(check(e).faults.empty());
  e.hands = {{1, {600}, {0}, {}}, {5, {600}, {0}, {}}};
  EXPECT_EQ(keysTold(check(e).faults), "environment");
}

TEST(NoObject, HasNeitherMassesNorCouplingNorConstraint) {
  const Experiment e = read(R"("hand_mass_kg": 1)");
  EXPECT_EQ(e.object.kind, ObjectKind::None);
  EXPECT_TRUE(e.object.masses.empty());
  EXPECT_TRUE(describe(e).starts_with("the hand without an object, free in space")) << describe(e);
  EXPECT_TRUE(holds(describe(e), "the hand within 0.01 m"));
  EXPECT_TRUE(holds(refused(R"("coupling": { "stiffness_n_per_m": 600 })"), "coupling: is given, but object.kind is none"));
  Experiment changed = e;
  changed.object.masses = {1};
  EXPECT_EQ(check(changed).faults.at(0).key, "object.kind");
  changed = e;
  changed.constraint.name = "line";
  changed.task->start = {0};
  changed.task->target = {1};
  EXPECT_EQ(keysTold(check(changed).faults), "object.kind");
}

TEST(CursorKeys, AreReadAndWritten) {
  const Experiment e = read(R"("cursor": { "rotation_deg": 30, "gain": 1.5, "delay_s": 0.1, "show": "movement-end", "judge": "hand" })");
  EXPECT_EQ(e.cursor, (Cursor{30, 1.5, std::nullopt, 0.1, CursorShow::MovementEnd, CursorJudge::Hand}));
  Experiment again = parseExperiment(toJson(e), "x.json");
  again.text = e.text;
  EXPECT_EQ(again, e);
  EXPECT_FALSE(read(R"("hand_mass_kg": 1)").cursor);
}

TEST(CursorKeys, RefuseWhatCannotBeReached) {
  EXPECT_TRUE(holds(refused(R"("cursor": { "gain": 0 })"), "cursor.gain: is 0"));
  EXPECT_TRUE(holds(refused(R"("cursor": { "clamp_deg": 30, "rotation_deg": 10 })"), "cursor.clamp_deg"));
  Experiment up = read(R"("cursor": { "rotation_deg": 30 })");
  EXPECT_TRUE(check(up).faults.empty());
  up.task->target = up.task->start, up.task->target[1] += 0.1;  // out of the horizontal plane
  EXPECT_EQ(keysTold(check(up).faults), "cursor.rotation_deg");
  up.task->plane = TaskPlane::Frontal;
  EXPECT_TRUE(check(up).faults.empty());
  Experiment e = readExperiment("chain-moderate");
  e.cursor.emplace();
  EXPECT_EQ(keysTold(check(e).faults), "cursor");
}

TEST(TaskPlane, RightIsWhereTheViewerSeesIt) {
  const Vec3 above = normalOf(TaskPlane::Horizontal), front = normalOf(TaskPlane::Frontal);
  EXPECT_EQ(rightOf({0, 0, -1}, above), (Vec3{1, 0, 0})) << "forward on the table";
  EXPECT_EQ(rightOf({1, 0, 0}, above), (Vec3{0, 0, 1})) << "to the right on the table: right of it is towards the subject";
  EXPECT_EQ(rightOf({0, 1, 0}, front), (Vec3{1, 0, 0})) << "up on a screen";
  EXPECT_EQ(rightOf({0, 1, 0}, above), Vec3{}) << "up has no right on the table";
}

TEST(TaskPlane, ARotationIsCounterclockwiseAndKeepsTheLength) {
  const Vec3 above = normalOf(TaskPlane::Horizontal);
  const Vec3 forward = rotated({1, 0, 0}, above, rotationInPlane(90));
  EXPECT_NEAR(norm(forward - Vec3{0, 0, -1}), 0, 1e-15) << "from the right to forward, as seen from above";
  const Vec3 v{0.3, 0.2, -0.5};
  const Vec3 turned = rotated(v, above, rotationInPlane(30));
  EXPECT_NEAR(norm(turned), norm(v), 1e-15);
  EXPECT_EQ(turned.y, v.y);
  EXPECT_NEAR(v.x * turned.x + v.z * turned.z, (v.x * v.x + v.z * v.z) * std::cos(std::numbers::pi / 6), 1e-15);
}

}  // namespace
}  // namespace reachlab::experiment
