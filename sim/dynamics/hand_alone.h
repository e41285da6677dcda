#pragma once
#include <memory>

#include "sim/dynamics/object/plant.h"

namespace reachlab::dynamics {

/// The plant of an experiment without an object. Its one mass is the hand itself, so that the task judges the hand. It exerts no force and
/// has no energy. A hand that is lost stays where it was seen last.
std::unique_ptr<Plant> makeHandAlone();

}  // namespace reachlab::dynamics
