#include "sim/dynamics/curve_system.h"
#include "sim/dynamics/cusp_adaptive.h"
#include "sim/dynamics/make_plant.h"

namespace reachlab {
namespace {

template <class System>
std::unique_ptr<Plant> makeHard(const ObjectModel& model, const System& system, const MethodRequest& request) {
  if (request.method == "rk4") return std::make_unique<SystemPlant<System, Rk4>>(model, system, request.tolerance);
  if (request.method == "stiff") return std::make_unique<SystemPlant<System, Stiff>>(model, system, request.tolerance);
  if (request.method == "adaptive") return std::make_unique<SystemPlant<System, CuspAdaptive>>(model, system, request.tolerance);
  return std::make_unique<SystemPlant<System, CuspAbm>>(model, system, request.tolerance);
}

template <int N, bool Parallel>
std::unique_ptr<Plant> make(const ObjectModel& model, const Constraint& constraint, const CurveForm& form, const MethodRequest& request) {
  if (!form.tangential) return makePlant(model, CurveSystem<N, Parallel, false>(model, constraint), request);
  CurveSystem<N, Parallel, true> system(model, constraint);
  system.speedScale = form.largestSpeed;
  return makeHard(model, system, request);
}

}  // namespace

std::unique_ptr<Plant> makeCurvePlant(const ObjectModel& model, const Constraint& constraint, const CurveForm& form,
                                      const MethodRequest& request) {
  if (model.kind == ObjectKind::Parallel)
    return model.count() == 2 ? make<2, true>(model, constraint, form, request) : make<0, true>(model, constraint, form, request);
  switch (model.count()) {
    case 1: return make<1, false>(model, constraint, form, request);
    case 5: return make<5, false>(model, constraint, form, request);
    default: return make<0, false>(model, constraint, form, request);
  }
}

}  // namespace reachlab
