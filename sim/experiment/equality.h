#pragma once
#include "sim/experiment/experiment.h"

namespace reachlab::experiment {

/// Equal in every key, and in the file's text.
bool operator==(const Experiment& a, const Experiment& b);
/// Whether both mean the same constraint, so that one compilation does for both.
bool isSameConstraint(const constraints::ConstraintSpec& a, const constraints::ConstraintSpec& b);

}  // namespace reachlab::experiment
