#pragma once
#include "sim/dynamics/object/plant.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::dynamics {

/// compileScene of an experiment that is valid, with the constraint it has already.
Scene compileScene(const experiment::CompiledExperiment& experiment, const SceneOptions& options = {});

/// The same for an experiment that was changed but for its constraint.
Scene compileScene(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const SceneOptions& options = {});

}  // namespace reachlab::dynamics
