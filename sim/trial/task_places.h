#pragma once
#include <string>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::trial {

/// What the way from start to target holds in store, one sentence each: places where the formula is not smooth, and a start at which
/// rounding decides which way the mass leaves when the hand goes straight to the target. Empty where nothing is to be told.
std::vector<Fault> describeWay(const experiment::CompiledExperiment& experiment);

}  // namespace reachlab::trial
