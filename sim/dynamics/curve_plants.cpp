#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/methods/cusp_adaptive.h"
#include "sim/dynamics/systems/batch_system.h"
#include "sim/dynamics/systems/curve_system.h"

namespace reachlab::dynamics {
namespace {

template <class System>
System makeSystem(const ObjectModel& model, const constraints::Constraint& constraint, const CurveForm& form) {
  System system(model, constraint, form.largestSpeed);
  system.seenLo = form.seenLo;
  system.seenHi = form.seenHi;
  return system;
}

template <bool Tangential, template <class> class SubSteps>
std::unique_ptr<Plant> make(const ObjectModel& model, const constraints::Constraint& constraint, const CurveForm& form,
                            const MethodRequest& request) {
  using Any = CurveSystem<0, Tangential>;
  using One = CurveSystem<1, Tangential>;
  using Batch = BatchSystem<1, Tangential>;
  using Batches = BatchSystem<0, Tangential>;
  if (request.method == "stiff") return makeStiffPlant<SystemPlant<Any>>(model, makeSystem<Any>(model, constraint, form), request);
  if (model.count() == 1) return makeExplicitPlant<SystemPlant<One>, SubSteps>(model, makeSystem<One>(model, constraint, form), request);
  if (model.count() <= kBatchLanes)
    return makeExplicitPlant<SystemPlant<Batch>, SubSteps>(model, makeSystem<Batch>(model, constraint, form), request);
  return makeExplicitPlant<SystemPlant<Batches>, SubSteps>(model, makeSystem<Batches>(model, constraint, form), request);
}

}  // namespace

std::unique_ptr<Plant> makeCurvePlant(const ObjectModel& model, const constraints::Constraint& constraint, const CurveForm& form,
                                      const MethodRequest& request) {
  return form.tangential ? make<true, CuspAdaptive>(model, constraint, form, request)
                         : make<false, Adaptive>(model, constraint, form, request);
}

}  // namespace reachlab::dynamics
