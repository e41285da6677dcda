#pragma once
#include <memory>

#include "sim/dynamics/linear_plant.h"

namespace reachlab {

/// The ways a scene can be computed, one function and one file each; the templates behind them are instantiated there only.
std::unique_ptr<Plant> makeExactPlant(const ObjectModel& model, const LinearSpace& space, double dt);

/// A straight scene's space: the line's axis, or free space when `constraint` is Free.
LinearSpace linearSpace(const Constraint& constraint);

}  // namespace reachlab
