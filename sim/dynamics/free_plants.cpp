#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/systems/free_system.h"

namespace reachlab::dynamics {

std::unique_ptr<Plant> makeFreePlant(const ObjectModel& model, const MethodRequest& request) {
  if (request.method == "stiff") return makeStiffPlant<SystemPlant<FreeSystem<0>>>(model, FreeSystem<0>(model), request);
  if (model.count() == 1) return makeExplicitPlant<SystemPlant<FreeSystem<1>>>(model, FreeSystem<1>(model), request);
  return makeExplicitPlant<SystemPlant<FreeSystem<0>>>(model, FreeSystem<0>(model), request);
}

}  // namespace reachlab::dynamics
