#pragma once
#include <optional>

#include "sim/dynamics/object/plant.h"
#include "sim/experiment/experiment.h"

namespace reachlab::dynamics {

/// The position error [m] of RK4 with `step` [s] over the reach. A minimum-jerk hand drives the plant along the chord from start to target
/// twice, with the step and with half of it. The estimate is the largest distance between the two positions of any mass, times 16/15 (order
/// 4). A reach that ends early counts up to its end, and the error is infinite if its first step fails. Returns no value where start and
/// target coincide. Leaves the plant at rest at the start. Allocates and is not for a tick.
std::optional<double> measureRk4Error(Plant& plant, const experiment::Task& task, const constraints::Constraint& constraint, double step);

}  // namespace reachlab::dynamics
