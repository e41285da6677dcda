#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/haptics/tick_engine.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// A recorded run simulated again from its inputs, held against what was recorded.
struct Replay {
  std::uint64_t ticks = 0, rows = 0;  // simulated, compared
  std::uint64_t rowsThatDiffer = 0;   // in any bit of any channel but the computer's clock
  std::string firstDifference;        // "tick 1250, mass1_pos_x: recorded 0.1, simulated 0.2"; empty if there is none
  std::vector<RecordedTrial> trials;  // as simulated
  int trialsThatDiffer = 0;
  bool identical() const { return rowsThatDiffer == 0 && trialsThatDiffer == 0; }
};

/// Feeds every recorded tick to a fresh engine of the recorded experiment. Bit-identical with the program that recorded, on
/// every level of processor; another compiler or version may round differently. Throws FaultError when ticks are missing in the log (dropped while recording),
/// and what the engine's construction throws.
Replay replayRun(const RunLog& log);

/// What a run needs that was moved at several stations: an engine on a copy, and what the others sent, between two ticks.
struct ReplayHooks {
  std::function<std::unique_ptr<haptics::TickEngine>(const experiment::CompiledExperiment&, const haptics::EngineOptions&)> makeEngine;
  std::function<void(const haptics::TickState& state)> afterTick;
  std::function<void(double* columns)> further;  // FurtherColumns, of the tick just simulated; without it they are not compared
};
Replay replayRun(const RunLog& log, const ReplayHooks& hooks);

}  // namespace reachlab::record
