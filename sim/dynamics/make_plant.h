#pragma once
#include <memory>

#include "sim/dynamics/compile.h"
#include "sim/dynamics/methods/abm.h"
#include "sim/dynamics/methods/adaptive.h"
#include "sim/dynamics/methods/rk4.h"
#include "sim/dynamics/methods/stiff.h"
#include "sim/dynamics/system_plant.h"

namespace reachlab::dynamics {

/// Maps the name of the method to its type, for one system.
template <class System>
std::unique_ptr<Plant> makePlant(const ObjectModel& model, const System& system, const MethodRequest& request) {
  if (request.method == "rk4") return std::make_unique<SystemPlant<System, Rk4>>(model, system, request.tolerance);
  if (request.method == "stiff") return std::make_unique<SystemPlant<System, Stiff>>(model, system, request.tolerance);
  if (request.method == "adaptive") return std::make_unique<SystemPlant<System, Adaptive>>(model, system, request.tolerance);
  return std::make_unique<SystemPlant<System, Abm>>(model, system, request.tolerance);
}

}  // namespace reachlab::dynamics
