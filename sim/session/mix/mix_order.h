#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "base/fault.h"
#include "sim/session/mix/trial_mix.h"

namespace reachlab::session {

/// One trial to a target, before the ways back are put between.
struct MixedTrial {
  int kind = 0;    // in kindsInUse
  int target = 0;  // from 0
};
/// The block's trials in their order, a function of the seed. Each cycle has its exact counts of kinds, and each run through the targets
/// has each target once. Kinds meet targets as evenly as the order allows. Requires `problems` of the mix to be empty.
std::vector<MixedTrial> orderTrials(const TrialMix& mix, int trials, std::uint64_t seed);
/// Why the rules `not_first` and `not_twice` leave no order of so many trials, under the key of the rule. Names and counts are sound.
std::optional<Fault> orderFault(const TrialMix& mix, int trials);

}  // namespace reachlab::session
