#pragma once
#include <cstdint>
#include <vector>

#include "sim/record/configuration/run_configuration.h"
#include "sim/session/plan.h"

namespace reachlab::session {

/// The trials of a block, in order, each with its scene (block_scenes.h). Kinds and targets, foreperiods and the places of the catch trials are
/// drawn from the seed. The foreperiod of trial i depends on (seed, i) alone, so that a resumed block has the same foreperiods.
std::vector<trial::PlannedTrial> planTrials(const PlanBlock& block, std::uint64_t seed);

/// The seed of a block, from the run's seed and the block's number from 1. Block 1 has the run's seed itself.
std::uint64_t blockSeed(std::uint64_t seed, int block);

}  // namespace reachlab::session
