#include <fmt/format.h>

#include <cmath>

#include "constraints/error.h"
#include "sim/dynamics/compile.h"
#include "sim/dynamics/plant.h"

namespace reachlab {

Scene compileScene(const Experiment& experiment, const SceneOptions& options) {
  Scene scene;
  scene.constraint = makeConstraint(experiment.constraint);
  if (scene.constraint.kind == ConstraintKind::Surface || (scene.constraint.kind == ConstraintKind::Curve && !scene.constraint.straight))
    throw RefusedError("dynamics on '" + scene.constraint.name + "' are not linear");
  const ObjectModel model = makeObjectModel(experiment);
  if (!(options.step > 0) || !std::isfinite(options.step)) throw RefusedError(fmt::format("the step must be positive, not {} s", options.step));
  const LinearSpace space = linearSpace(scene.constraint);
  if (space.axes == 1 && !(norm(space.tangent) > 0)) throw RefusedError("the line has no length: nothing can move along it; give length_m > 0");
  scene.plant = makeExactPlant(model, space, options.step);
  scene.choice.method = "exact";
  scene.choice.form = fmt::format("line, {} states", 2 * model.count());
  scene.choice.fastestMode = boundFastestMode(model);
  scene.choice.predictedError = 1e-14;
  scene.choice.reason = "linear with constant coefficients: the matrix exponential is exact for any stiffness and damping";
  if (experiment.task && !experiment.task->start.empty()) scene.plant->placeAtRest(experiment.task->start);
  return scene;
}

}  // namespace reachlab
