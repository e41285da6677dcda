#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/haptics/tick_engine.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// A recorded run that is simulated again from its inputs and compared with the record.
struct Replay {
  std::uint64_t ticks = 0, rows = 0;  // simulated, compared
  std::uint64_t rowsThatDiffer = 0;   // in any bit of any channel but the computer's clock
  std::string firstDifference;        // "tick 1250, mass1_pos_x: recorded 0.1, simulated 0.2"; empty if there is none
  std::vector<RecordedTrial> trials;  // as simulated
  int trialsThatDiffer = 0;
  bool identical() const { return rowsThatDiffer == 0 && trialsThatDiffer == 0; }
};

/// The parts that the replay of a run at several stations needs: an engine on a copy, and the other stations' samples between two ticks.
struct ReplayHooks {
  std::function<std::unique_ptr<haptics::TickEngine>(const experiment::CompiledExperiment&, const haptics::EngineOptions&)> makeEngine;
  std::function<void(const haptics::TickState& state)> afterTick;
  std::function<void(double* columns)> further;  // FurtherColumns, of the tick just simulated; without it they are not compared
};
/// Feeds every recorded tick to a fresh engine of the recorded experiment. The result is bit-identical with the program that recorded, on
/// every level of processor. Another compiler or version may round differently. Throws FaultError when ticks are missing in the log
/// (dropped while recording), and the errors of the engine's construction.
Replay replayRun(const RunLog& log, const ReplayHooks& hooks = {});

}  // namespace reachlab::record
