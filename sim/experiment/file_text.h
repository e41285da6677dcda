#pragma once
#include <string>

#include "sim/experiment/experiment_fwd.h"

namespace reachlab::experiment {

/// An experiment as a file: toJson with the description that its text has. Comments of the text are left out.
std::string fileText(const Experiment& experiment);

}  // namespace reachlab::experiment
