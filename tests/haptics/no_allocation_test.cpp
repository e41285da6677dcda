#include <gtest/gtest.h>

#include "base/fault.h"
#include "cli/bench/allocation_count.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/haptics/haptic_loop.h"
#include "tests/bare_reach.h"
#include "tests/dynamics/make_experiment.h"
#include "tests/haptics/scripted_device.h"
#include "tests/refusal.h"

namespace reachlab::haptics {
namespace {

// A loop whose hand moves by 2 cm in 0.4 s.
HapticLoop onVirtualClock(std::unique_ptr<TickEngine> engine, test::MemorySink& sink) {
  const Vec3 start = engine->protocol().start;
  const auto device = std::make_shared<test::ScriptedDevice>(start.x, start.x + 0.02, 400);
  device->beside = start;
  return HapticLoop(std::move(engine), device, &sink, {.virtualClock = true, .clock = {}});
}

// A whole trial: put up, armed, moved, judged, put up again, with every tick handed to window and recorder.
std::uint64_t allocationsOfThreeTrials(experiment::Experiment experiment) {
  experiment.task->rest = experiment::kNoStartRest;
  test::MemorySink sink(10);
  HapticLoop loop = onVirtualClock(std::make_unique<TickEngine>(experiment, EngineOptions{}), sink);
  const std::uint64_t before = cli::countAllocations();
  for (int i = 0; i < 3000; ++i) {
    if (i % 1000 == 0) loop.tryCommand(i == 0 ? trial::Command::NextTrial : trial::Command::Abort);
    if (i % 1000 == 1) loop.tryCommand(trial::Command::NextTrial);
    loop.advance();
    loop.takeLatest();
  }
  EXPECT_GE(loop.engine().state().trial, 1);
  EXPECT_GT(loop.engine().state().faults.steps[0], 400u) << "steps were taken";
  return cli::countAllocations() - before;
}

TEST(HapticLoop, TickAllocatesNothingInAnyShippedExperiment) {
  for (const std::string& name : experiment::shippedExperiments())
    EXPECT_EQ(allocationsOfThreeTrials(experiment::readExperiment(name)), 0u) << name;
}

// The scene changes with each of four trials, between forces of every kind and an object without a field.
TEST(HapticLoop, TickThatChangesTheSceneAllocatesNothing) {
  experiment::Experiment plain = experiment::readExperiment("chain-moderate");
  plain.task->rest = experiment::kNoStartRest;
  experiment::Experiment field = plain;
  field.object.viscosity = 3;
  field.environment = {{experiment::curl(13)}, {experiment::ChannelForce{}, experiment::ForceWhen::Trial}};
  const std::vector<experiment::CompiledExperiment> scenes{experiment::CompiledExperiment(plain), experiment::CompiledExperiment(field)};
  test::MemorySink sink(10);
  HapticLoop loop = onVirtualClock(std::make_unique<TickEngine>(scenes, EngineOptions{}), sink);
  const std::uint64_t before = cli::countAllocations();
  bool felt[2] = {false, false};
  for (int i = 0; i < 4000; ++i) {
    const int scene = i / 1000 % 2;
    if (i % 1000 == 0 && i > 0) loop.tryCommand(trial::Command::Abort);
    if (i % 1000 == (i == 0 ? 0 : 1)) loop.tryCommand(trial::Command::NextTrial, {.index = i / 1000, .scene = scene});
    loop.advance();
    loop.takeLatest();
    if (i % 1000 > 1 && !(loop.engine().state().environment.force == Vec3{})) felt[scene] = true;
  }
  EXPECT_EQ(cli::countAllocations() - before, 0u);
  EXPECT_EQ(loop.engine().state().trial, 4);
  EXPECT_FALSE(felt[0]);
  EXPECT_TRUE(felt[1]);
}

TEST(TickEngine, RefusesScenesThatCannotShareARecord) {
  const experiment::Experiment first = experiment::readExperiment("chain-moderate");
  const auto refusedKey = [&](void (*change)(experiment::Experiment&)) -> std::string {
    experiment::Experiment other = first;
    change(other);
    const std::vector<experiment::CompiledExperiment> scenes{experiment::CompiledExperiment(first), experiment::CompiledExperiment(other)};
    return keysTold(faultsToldBy([&] { TickEngine engine(scenes, EngineOptions{}); }));
  };
  EXPECT_EQ(refusedKey([](experiment::Experiment& e) { e.forceLimit = 3; }), "force_limit_n");
  EXPECT_EQ(refusedKey([](experiment::Experiment& e) { e.task->rest.seconds = 0.7; }), "task.rest_s");
  EXPECT_EQ(refusedKey([](experiment::Experiment& e) { e.velocityEstimator.kind = "difference"; }), "velocity_estimator");
  EXPECT_EQ(refusedKey([](experiment::Experiment& e) { e.timing.maxMissedTicks = 4; }), "timing");
  EXPECT_EQ(refusedKey([](experiment::Experiment& e) {
              e.object.masses.pop_back();
              e.object.stiffness.pop_back();
              e.object.damping.pop_back();
            }),
            "object.masses_kg");
  EXPECT_EQ(refusedKey([](experiment::Experiment& e) { e.task->target = {5}; }), "");
}

TEST(HapticLoop, TickAllocatesNothingUnderAnyForceAndWithACursor) {
  experiment::Experiment e = experiment::readExperiment("chain-moderate");
  e.environment = {{experiment::curl(13)},
                   {experiment::ElasticForce{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}}},
                   {experiment::JointViscousForce{{{{0.1, 0}, {0, 0.1}}}}},
                   {experiment::ChannelForce{}, experiment::ForceWhen::Trial},
                   {experiment::PulseForce{{0, 1, 0}, {0.1, {}}}}};
  EXPECT_EQ(allocationsOfThreeTrials(e), 0u);
  e.constraint = {};
  e.constraint.name = "free";
  e.object = {};
  e.object.kind = experiment::ObjectKind::None;
  e.coupling.reset();
  e.task->start = {0, 0, 0};
  e.task->target = {0.02, 0, 0};
  e.cursor.emplace();
  EXPECT_EQ(allocationsOfThreeTrials(e), 0u);
}

TEST(HapticLoop, TickAllocatesNothingOnAnyKindOfConstraintWithAnyMethod) {
  using experiment::Experiment;
  Experiment chain = dynamics::makeChain(2, 0.6, 600, {600, 1});
  chain.object.damping = {1};
  const Experiment point = dynamics::makePoint(1, {600, 1});
  const Experiment onTorus = dynamics::onSurface("(0.1+0.04*cos(u))*cos(v)", "(0.1+0.04*cos(u))*sin(v)", "0.04*sin(u)");
  const auto onEllipse = [](const Experiment& e) {
    Experiment moved = dynamics::onCurve(e, "a*cos(phi)", "0", "b*sin(phi)");
    moved.constraint.shape = {{"a", 0.1}, {"b", 0.06}};
    return moved;
  };
  const std::vector<std::pair<Experiment, std::vector<const char*>>> cases{
      {dynamics::from(chain, {0}, {6}), {"auto", "rk4", "exact", "abm", "adaptive", "stiff"}},
      {dynamics::from(onEllipse(point), {0}, {3}), {"auto", "rk4", "abm", "adaptive", "stiff"}},
      {dynamics::from(onEllipse(chain), {0}, {3}), {"auto", "rk4", "abm", "adaptive", "stiff"}},
      {dynamics::from(onTorus, {0, 0}, {1, 1}), {"auto", "rk4", "abm", "adaptive", "stiff"}},
      {dynamics::from(dynamics::free(point), {0, 0, 0}, {0.1, 0, 0}), {"auto", "rk4", "exact"}}};
  for (const auto& [made, methods] : cases)
    for (const char* method : methods) {
      Experiment e = made;
      e.method = method;
      EXPECT_EQ(allocationsOfThreeTrials(e), 0u) << toJson(e);
    }
}

}  // namespace
}  // namespace reachlab::haptics
