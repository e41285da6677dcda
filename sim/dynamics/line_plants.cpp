#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/systems/line_system.h"

namespace reachlab::dynamics {
namespace {

template <int N>
std::unique_ptr<Plant> make(const ObjectModel& model, const LinearSpace& space, const MethodRequest& request) {
  return makeExplicitPlant<SystemPlant<LineSystem<N>>>(model, LineSystem<N>(model, space), request);
}

}  // namespace

std::unique_ptr<Plant> makeLinePlant(const ObjectModel& model, const LinearSpace& space, const MethodRequest& request) {
  if (request.method == "stiff") return makeStiffPlant<SystemPlant<LineSystem<0>>>(model, LineSystem<0>(model, space), request);
  switch (model.count()) {
    case 1: return make<1>(model, space, request);
    case 2: return make<2>(model, space, request);
    case 5: return make<5>(model, space, request);
    default: return make<0>(model, space, request);
  }
}

}  // namespace reachlab::dynamics
