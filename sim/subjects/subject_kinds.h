#pragma once
#include <span>
#include <string>

#include "sim/subjects/plans/simulated_hand.h"

namespace reachlab::subjects {

/// prepareSubjects for a device text `simulated:KEY=VALUE,…`, for the kind that the text names.
MakeSubject prepareSubjects(const experiment::CompiledExperiment& experiment, const std::string& device);
/// The same for the scenes of a block. The hand does each trial in the scene of its number, and keeps what it learns from one to the next.
MakeSubject prepareSubjects(std::span<const experiment::CompiledExperiment> scenes, const std::string& device);

}  // namespace reachlab::subjects
