#pragma once
#include <vector>

#include "base/fault.h"
#include "base/math/vec3.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::trial {

/// The position [m] in the world frame where the hand of this experiment begins. It is the origin without a task.
Vec3 startOf(const experiment::CompiledExperiment& experiment);

/// Warnings about the path from start to target, one sentence each. It tells of places where the formula is not smooth. It also tells of a
/// start at which rounding decides the direction in which the mass leaves. Empty if there is nothing to tell.
std::vector<Fault> describeWay(const experiment::CompiledExperiment& experiment);

}  // namespace reachlab::trial
