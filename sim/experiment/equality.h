#pragma once
#include "sim/experiment/experiment.h"

namespace reachlab::experiment {

/// Equal in every key, and in the file's text.
bool operator==(const Experiment& a, const Experiment& b);

}  // namespace reachlab::experiment
