#include "sim/dynamics/curve_system.h"
#include "sim/dynamics/make_plant.h"

namespace reachlab {
namespace {

template <bool Tangential>
std::unique_ptr<Plant> make(const ObjectModel& model, const Constraint& constraint, const MethodRequest& request) {
  if (model.kind == ObjectKind::Parallel) {
    if (model.count() == 2) return makePlant(model, CurveSystem<2, true, Tangential>(model, constraint), request);
    return makePlant(model, CurveSystem<0, true, Tangential>(model, constraint), request);
  }
  switch (model.count()) {
    case 1: return makePlant(model, CurveSystem<1, false, Tangential>(model, constraint), request);
    case 5: return makePlant(model, CurveSystem<5, false, Tangential>(model, constraint), request);
    default: return makePlant(model, CurveSystem<0, false, Tangential>(model, constraint), request);
  }
}

}  // namespace

std::unique_ptr<Plant> makeCurvePlant(const ObjectModel& model, const Constraint& constraint, bool tangential, const MethodRequest& request) {
  return tangential ? make<true>(model, constraint, request) : make<false>(model, constraint, request);
}

}  // namespace reachlab
