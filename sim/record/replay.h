#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "sim/record/run_log.h"

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

/// Feeds every recorded tick to a fresh engine of the recorded experiment. Bit-identical with the program that recorded; another
/// processor or compiler may round differently. Throws FaultError when ticks are missing in the log (dropped while recording),
/// and what the engine's construction throws.
Replay replayRun(const RunLog& log);

}  // namespace reachlab::record
