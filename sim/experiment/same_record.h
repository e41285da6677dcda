#pragma once
#include <optional>

#include "base/fault.h"
#include "sim/experiment/experiment_fwd.h"

namespace reachlab::experiment {

/// The scenes of one run share its record: constraint, kind of object, number of masses, hands, velocity estimator, device's force limit,
/// limits of timing, and rest at the start. Returns the first key in which `other` differs from `first` in these, or nullopt.
std::optional<Fault> differenceInRecord(const Experiment& first, const Experiment& other);

}  // namespace reachlab::experiment
