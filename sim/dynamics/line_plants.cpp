#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/systems/line_system.h"

namespace reachlab::dynamics {

std::unique_ptr<Plant> makeLinePlant(const ObjectModel& model, const LinearSpace& space, const MethodRequest& request) {
  if (model.kind == experiment::ObjectKind::Parallel) {
    if (model.count() == 2) return makePlant(model, LineSystem<2, true>(model, space), request);
    return makePlant(model, LineSystem<0, true>(model, space), request);
  }
  switch (model.count()) {
    case 1: return makePlant(model, LineSystem<1, false>(model, space), request);
    case 2: return makePlant(model, LineSystem<2, false>(model, space), request);
    case 5: return makePlant(model, LineSystem<5, false>(model, space), request);
    default: return makePlant(model, LineSystem<0, false>(model, space), request);
  }
}

}  // namespace reachlab::dynamics
