#include "network/link/station_replay.h"

#include <fmt/format.h>

#include "base/fault.h"
#include "network/link/given_samples.h"
#include "network/link/link_channels.h"
#include "network/link/station_sink.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/experiment.h"

namespace reachlab::network {

record::Replay replayStation(const record::RunLog& log, const LookAtCopy& look) {
  const GivenRecord recorded = readGiven(log);
  if (recorded.own < 0)
    throw FaultError(Fault{{}, "holds nothing of the other stations, so the run cannot be simulated again", {}, FilePlace{log.path()}});
  CoupledCopy* copy = nullptr;
  std::size_t next = 0;
  record::ReplayHooks hooks;
  hooks.makeEngine = [&](const experiment::CompiledExperiment& experiment, const haptics::EngineOptions& options) {
    return makeStationEngine(experiment, recorded.own, options, copy);
  };
  hooks.afterTick = [&](const haptics::TickState& state) {
    if (look) look(state, *copy);
    copy->beginTick(timeAfter(state));
    for (; next < recorded.samples.size() && recorded.samples[next].tick <= state.tick; ++next) recorded.samples[next].giveTo(*copy);
  };
  hooks.further = [&](double* columns) { fillLinks(*copy, columns); };
  return record::replayRun(log, hooks);
}

std::unique_ptr<haptics::TickEngine> makeStationEngine(const experiment::CompiledExperiment& experiment, int own,
                                                       const haptics::EngineOptions& options, CoupledCopy*& copy) {
  experiment::Experiment e = experiment.experiment();
  dynamics::Scene scene = dynamics::compileScene(experiment);  // with all that it refuses
  auto plant = std::make_unique<CoupledCopy>(e, experiment.constraint(), own, copySettingsFor(e));
  copy = plant.get();
  e.object.fpOffset = e.hands.at(static_cast<std::size_t>(own)).fpOffset;
  scene.choice.form = fmt::format("copy of station {} of {}", own + 1, e.hands.size());
  scene.choice.reason = "stations move the object together: a full copy at each, rk4, one step a tick";
  scene.shared = nullptr;
  scene.plant = std::move(plant);
  return std::make_unique<haptics::TickEngine>(e, std::move(scene), options);
}

}  // namespace reachlab::network
