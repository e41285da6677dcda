#pragma once
#include <string>

#include "sim/experiment/experiment_fwd.h"

namespace reachlab::experiment {

/// Object, constraint and task in one sentence with units, for readers of reports and datasets who do not have the program.
/// Throws FaultError where it names a constraint that is not known.
std::string describe(const Experiment& experiment);

/// The time that is asked for: "1.5 ± 0.6 s". A tolerance as long as the reach asks for no pace and only says when it must be over:
/// "within 10 s".
std::string describePace(const Task& task);

}  // namespace reachlab::experiment
