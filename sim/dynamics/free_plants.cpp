#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/systems/free_system.h"

namespace reachlab::dynamics {

std::unique_ptr<Plant> makeFreePlant(const ObjectModel& model, const MethodRequest& request) {
  if (model.kind == experiment::ObjectKind::Parallel) return makePlant(model, FreeSystem<0, true>(model), request);
  if (model.count() == 1) return makePlant(model, FreeSystem<1, false>(model), request);
  return makePlant(model, FreeSystem<0, false>(model), request);
}

}  // namespace reachlab::dynamics
