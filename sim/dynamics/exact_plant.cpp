#include "constraints/constraint.h"
#include "sim/dynamics/compile.h"
#include "sim/dynamics/exact/dense_core.h"
#include "sim/dynamics/exact/linear_plant.h"
#include "sim/dynamics/exact/oscillator_core.h"

namespace reachlab::dynamics {
namespace {

template <class Core>
std::unique_ptr<Plant> make(const ObjectModel& model, const LinearSpace& space, double dt) {
  if (space.axes == 1) return std::make_unique<LinearPlant<Core, 1>>(model, space, dt);
  return std::make_unique<LinearPlant<Core, 3>>(model, space, dt);
}

// Up to eight masses the compiler knows how many there are.
template <int N = 8>
std::unique_ptr<Plant> makeDense(const ObjectModel& model, const LinearSpace& space, double dt) {
  if constexpr (N > 0)
    if (model.count() != N) return makeDense<N - 1>(model, space, dt);
  return make<DenseCore<N>>(model, space, dt);
}

}  // namespace

LinearSpace linearSpace(const constraints::Constraint& constraint) {
  if (constraint.kind == constraints::ConstraintKind::Free) return {3, {}, {}, {}};
  const constraints::CurvePoint p = constraints::evaluate(constraint.curve, 0.0);
  return {1, p.r, p.rPhi, constraint.domain[0]};
}

std::unique_ptr<Plant> makeExactPlant(const ObjectModel& model, const LinearSpace& space, double dt) {
  if (model.kind == experiment::ObjectKind::Parallel) return make<OscillatorCore>(model, space, dt);
  // In its modes a chain costs less from three masses on, and no state waits for another.
  if (model.count() >= 3 && canBeModal(model)) return make<OscillatorCore>(model, space, dt);
  return makeDense(model, space, dt);
}

}  // namespace reachlab::dynamics
