#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/methods/cusp_adaptive.h"
#include "sim/dynamics/systems/broken_curve_system.h"

namespace reachlab::dynamics {

std::unique_ptr<Plant> makeBrokenCurvePlant(const ObjectModel& model, const constraints::Constraint& constraint,
                                            std::shared_ptr<const constraints::CurveRegularity> regularity, double typicalSpeed,
                                            const MethodRequest& request) {
  using One = SystemPlant<BrokenCurveSystem<1>>;
  using Any = SystemPlant<BrokenCurveSystem<0>>;
  if (request.method == "stiff") return makeStiffPlant<Any>(model, {model, constraint, regularity, typicalSpeed}, request);
  if (model.count() == 1) return makeExplicitPlant<One, CuspAdaptive>(model, {model, constraint, regularity, typicalSpeed}, request);
  return makeExplicitPlant<Any, CuspAdaptive>(model, {model, constraint, regularity, typicalSpeed}, request);
}

}  // namespace reachlab::dynamics
