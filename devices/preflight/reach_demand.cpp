#include "devices/preflight/reach_demand.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/tick_engine.h"
#include "sim/haptics/tick_order.h"
#include "sim/subjects/plans/simulated_hand.h"

namespace reachlab::devices {
namespace {

constexpr double kNoLimit = 1e9;               // [N] the engine's own clamp is out of the way
constexpr std::uint64_t kMostTicks = 120'000;  // a task longer than two minutes is judged by its first two

ReachDemand rigidBodyDemand(const experiment::Experiment& experiment, const trial::ProtocolSettings& settings, const Vec3& centre,
                            const std::string& why) {
  const double mass = std::accumulate(experiment.object.masses.begin(), experiment.object.masses.end(), 0.0);
  const double unit = mass * norm(settings.target - settings.start) / (experiment.task->duration * experiment.task->duration);
  const double weight = mass * norm(experiment.object.gravity);
  return {.peakForce = 10 / std::sqrt(3.0) * unit + weight,
          .rmsForce = std::hypot(std::sqrt(120.0 / 7) * unit, weight),
          .farthest = std::max(norm(settings.start - centre), norm(settings.target - centre)),
          .law = "its whole mass as one rigid body (" + why + ")"};
}

/// The stages of a tick of a practised hand on the virtual clock.
struct PractisedHand : haptics::NoStages {
  haptics::HapticDevice& hand;
  const haptics::TickEngine& engine;
  PractisedHand(haptics::HapticDevice& theHand, const haptics::TickEngine& theEngine) : hand(theHand), engine(theEngine) {}

  bool read(haptics::TickInput& input) noexcept {
    input.devices[0] = hand.read();
    return true;
  }
  void command(haptics::TickInput& input) noexcept {
    input.command = engine.state().tick == 0 ? trial::Command::NextTrial : trial::Command::None;
  }
  bool write(const haptics::TickInput&) noexcept {
    if (const auto cue = engine.cue()) hand.cue(*cue);
    return true;
  }
};

ReachDemand simulatedDemand(const experiment::CompiledExperiment& experiment, haptics::TickEngine& engine, const Vec3& centre) {
  subjects::SubjectSpec practised;
  practised.noise = 0;
  const auto hand = subjects::makeSimulatedHand(experiment, practised, 0);
  hand->prepareTrial(0);
  ReachDemand demand;
  double squares = 0;
  std::uint64_t moving = 0;
  const haptics::TickState& state = engine.state();
  haptics::TickInput input;
  while (state.tick < kMostTicks && state.phase != trial::Phase::Done) {
    haptics::runTick(engine, input, PractisedHand(*hand, engine));
    if (!trial::isEngaged(state.phase)) continue;
    const double force = norm(state.hands[0].feedbackForce);
    demand.peakForce = std::max(demand.peakForce, force);
    demand.farthest = std::max(demand.farthest, norm(input.devices[0].position - centre));
    if (state.phase != trial::Phase::Moving) continue;
    squares += force * force;
    ++moving;
  }
  if (moving == 0) throw RefusedError("the simulated subject does not move the object");
  demand.rmsForce = std::sqrt(squares / static_cast<double>(moving));
  demand.law = "a practised reach, simulated";
  return demand;
}

}  // namespace

ReachDemand computeReachDemand(const experiment::CompiledExperiment& experiment, std::optional<double> duration, const Vec3& centre) {
  experiment::Experiment asked = experiment.experiment();
  asked.forceLimit.reset();
  asked.forceLimitEndsTrial = false;
  if (asked.task && duration) asked.task->duration = *duration;
  if (asked.task) asked.task->timeout = experiment::kMaxDuration;  // a slow reach leaves the start late
  haptics::EngineOptions options;
  options.hands[0].maxForce = kNoLimit;
  options.hands[0].virtualHand = true;
  const experiment::CompiledExperiment compiled(asked, experiment);
  ReachDemand demand;
  if (asked.hands.size() > 1) {
    demand =
        rigidBodyDemand(asked, trial::makeProtocolSettings(asked, compiled.constraint()), centre, "one of its hands may bear it alone");
    demand.duration = asked.task->duration;
    return demand;
  }
  haptics::TickEngine engine(compiled, options);
  try {
    demand = simulatedDemand(compiled, engine, centre);
  } catch (const Error& error) {  // a task that nobody can plan is still felt
    demand = rigidBodyDemand(asked, engine.protocol(), centre, error.what());
    demand.withoutEnvironment = !asked.environment.empty();
  }
  for (const Vec3& place : engine.protocol().via) demand.farthest = std::max(demand.farthest, norm(place - centre));
  demand.duration = asked.task->duration;
  return demand;
}

}  // namespace reachlab::devices
