#pragma once
#include <string>

#include "sim/experiment/experiment.h"

namespace reachlab::experiment {

/// What is moved, on what, and what is asked, in one sentence with units: for reports and datasets, which are read without the program.
/// Throws UsageError where it names a constraint that is not known.
std::string describe(const Experiment& experiment);

}  // namespace reachlab::experiment
