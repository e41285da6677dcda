#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "constraints/constraint_spec.h"
#include "sim/dynamics/method_choice.h"
#include "sim/dynamics/object/plant.h"

namespace reachlab::experiment {
struct Experiment;
class CompiledExperiment;
}  // namespace reachlab::experiment

namespace reachlab::dynamics {

struct SceneOptions {
  std::string method;    // empty: the experiment's
  double step = 0.001;   // [s]
  double tolerance = 0;  // adaptive methods; 0: default
};

class SharedPlant;

struct Scene {
  std::unique_ptr<Plant> plant;
  SharedPlant* shared = nullptr;  // the same plant where several hands hold the object (shared_plant.h)
  MethodChoice choice;
  std::shared_ptr<const constraints::Constraint> constraint;
};

/// Compiles the experiment. Throws RefusedError (unstable method, singular start …) with numbers and a remedy.
Scene compileScene(const experiment::Experiment& experiment, const SceneOptions& options = {});
/// The same for a valid experiment whose constraint has been made already.
Scene compileScene(const experiment::CompiledExperiment& experiment, const SceneOptions& options = {});
/// The scenes of the trials of a block. Throws FaultError for an experiment without a task, because a trial needs a task.
std::vector<Scene> compileScenes(std::span<const experiment::CompiledExperiment> experiments);
/// The same for an experiment that was changed, except for its constraint.
Scene compileScene(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const SceneOptions& options = {});

}  // namespace reachlab::dynamics
