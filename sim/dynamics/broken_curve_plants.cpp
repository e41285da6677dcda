#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/methods/cusp_adaptive.h"
#include "sim/dynamics/systems/broken_curve_system.h"

namespace reachlab::dynamics {
namespace {

template <class System>
using CuspMultistep = AbmWith<System, CuspAdaptive>;

template <class System>
std::unique_ptr<Plant> make(const ObjectModel& model, const System& system, const MethodRequest& request) {
  if (request.method == "rk4") return std::make_unique<SystemPlant<System, Rk4>>(model, system, request.tolerance);
  if (request.method == "stiff") return std::make_unique<SystemPlant<System, Stiff>>(model, system, request.tolerance);
  if (request.method == "adaptive") return std::make_unique<SystemPlant<System, CuspAdaptive>>(model, system, request.tolerance);
  return std::make_unique<SystemPlant<System, CuspMultistep>>(model, system, request.tolerance);
}

}  // namespace

std::unique_ptr<Plant> makeBrokenCurvePlant(const ObjectModel& model, const constraints::Constraint& constraint,
                                            std::shared_ptr<const constraints::CurveRegularity> regularity, double typicalSpeed,
                                            const MethodRequest& request) {
  if (model.kind == experiment::ObjectKind::Parallel)
    return make(model, BrokenCurveSystem<0, true>(model, constraint, regularity, typicalSpeed), request);
  if (model.count() == 1) return make(model, BrokenCurveSystem<1, false>(model, constraint, regularity, typicalSpeed), request);
  return make(model, BrokenCurveSystem<0, false>(model, constraint, regularity, typicalSpeed), request);
}

}  // namespace reachlab::dynamics
