#pragma once
#include <functional>
#include <memory>

#include "network/coupled_copy.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/tick_engine.h"
#include "sim/record/log/run_log.h"
#include "sim/record/replay.h"

namespace reachlab::network {

/// Replays a station's run from its log: the samples of its hand and of the other stations. `look` sees every tick, before the new samples
/// are taken. Throws as record::replayRun does.
using LookAtCopy = std::function<void(const haptics::TickState& state, const CoupledCopy& copy)>;
record::Replay replayStation(const record::RunLog& log, const LookAtCopy& look = {});

/// The engine of one station: its hand on its copy of the object. `copy` becomes part of the engine. Throws as CoupledCopy does.
std::unique_ptr<haptics::TickEngine> makeStationEngine(const experiment::CompiledExperiment& experiment, int own,
                                                       const haptics::EngineOptions& options, CoupledCopy*& copy);

}  // namespace reachlab::network
