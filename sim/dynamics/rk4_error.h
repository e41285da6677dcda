#pragma once
#include <optional>

#include "sim/dynamics/object/plant.h"
#include "sim/experiment/experiment.h"

namespace reachlab::dynamics {

/// What RK4 with `step` [s] errs in position over the reach itself: the plant is driven along the chord from start to target by a minimum-jerk
/// hand twice, with the step and with half of it, and the largest distance between any mass's two places, times 16/15 (order 4), is the
/// estimate [m]. A reach that ends early counts up to there; nothing where start and target are one place. Leaves the plant at rest at the start.
/// Allocates; not for a tick.
std::optional<double> measureRk4Error(Plant& plant, const experiment::Task& task, const constraints::Constraint& constraint, double step);

}  // namespace reachlab::dynamics
