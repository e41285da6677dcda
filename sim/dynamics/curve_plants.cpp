#include <type_traits>

#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/methods/cusp_adaptive.h"
#include "sim/dynamics/systems/batch_system.h"
#include "sim/dynamics/systems/curve_system.h"

namespace reachlab::dynamics {
namespace {

template <class System>
using SubSteps = std::conditional_t<System::kTangential, CuspAdaptive<System>, Adaptive<System>>;
template <class System>
using Multistep = AbmWith<System, SubSteps>;

template <class System>
std::unique_ptr<Plant> makeExplicit(const ObjectModel& model, const System& system, const MethodRequest& request) {
  if (request.method == "rk4") return std::make_unique<SystemPlant<System, Rk4>>(model, system, request.tolerance);
  if (request.method == "adaptive") return std::make_unique<SystemPlant<System, SubSteps>>(model, system, request.tolerance);
  return std::make_unique<SystemPlant<System, Multistep>>(model, system, request.tolerance);
}

template <class System>
System makeSystem(const ObjectModel& model, const constraints::Constraint& constraint, const CurveForm& form) {
  System system(model, constraint, form.largestSpeed);
  system.seenLo = form.seenLo;
  system.seenHi = form.seenHi;
  return system;
}

template <bool Parallel, bool Tangential>
std::unique_ptr<Plant> make(const ObjectModel& model, const constraints::Constraint& constraint, const CurveForm& form,
                            const MethodRequest& request) {
  if (request.method == "stiff") {
    using System = CurveSystem<0, Parallel, Tangential>;
    return std::make_unique<SystemPlant<System, Stiff>>(model, makeSystem<System>(model, constraint, form), request.tolerance);
  }
  if (model.count() == 1) return makeExplicit(model, makeSystem<CurveSystem<1, Parallel, Tangential>>(model, constraint, form), request);
  if (model.count() <= kBatchLanes)
    return makeExplicit(model, makeSystem<BatchSystem<1, Parallel, Tangential>>(model, constraint, form), request);
  return makeExplicit(model, makeSystem<BatchSystem<0, Parallel, Tangential>>(model, constraint, form), request);
}

}  // namespace

std::unique_ptr<Plant> makeCurvePlant(const ObjectModel& model, const constraints::Constraint& constraint, const CurveForm& form,
                                      const MethodRequest& request) {
  if (model.kind == experiment::ObjectKind::Parallel)
    return form.tangential ? make<true, true>(model, constraint, form, request) : make<true, false>(model, constraint, form, request);
  return form.tangential ? make<false, true>(model, constraint, form, request) : make<false, false>(model, constraint, form, request);
}

}  // namespace reachlab::dynamics
