#pragma once
#include <functional>
#include <memory>

#include "network/coupled_copy.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/tick_engine.h"
#include "sim/record/log/run_log.h"
#include "sim/record/replay.h"

namespace reachlab::network {

/// A station's run again, from its own log: its hand's samples and what the others sent. `look` sees every tick, before what came then is
/// taken. Throws as record::replayRun.
using LookAtCopy = std::function<void(const haptics::TickState& state, const CoupledCopy& copy)>;
record::Replay replayStation(const record::RunLog& log, const LookAtCopy& look = {});

/// The engine of one station: its own hand on its copy of the object. `copy` becomes the engine's. Throws what CoupledCopy throws.
std::unique_ptr<haptics::TickEngine> makeStationEngine(const experiment::CompiledExperiment& experiment, int own,
                                                       const haptics::EngineOptions& options, CoupledCopy*& copy);

}  // namespace reachlab::network
