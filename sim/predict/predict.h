#pragma once
#include <memory>
#include <span>

#include "base/fault.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

struct PredictOptions {
  double duration = 0;                  // [s] 0: the task's
  std::optional<double> handMass = {};  // [kg] nullopt: the experiment's
  double handDamping = 0;               // [N s/m] of the hand itself
  int unknowns = 0;                     // transcribed cases; 0: chosen for 1e-8
  std::optional<PointIs> point = {};    // nullopt: as the constraint means it
  /// Predictions of the same experiment, criterion and hand at other durations, or empty. Iterative solutions (joint torque change along a
  /// line) start from the polynomial in T through their unknowns. They use the same number of unknowns, unless that number is too small.
  std::span<const Prediction* const> near = {};
};

/// Of an experiment that has no task.
Fault missingTaskFault();

/// Throws RefusedError (uncontrollable, condition > 1e12 …) and FaultError (no task, criterion not defined here).
std::unique_ptr<Prediction> predict(const experiment::CompiledExperiment& experiment, Criterion criterion,
                                    const PredictOptions& options = {});
/// The same for an experiment that was changed but for its constraint, which is compiled already.
std::unique_ptr<Prediction> predict(const experiment::Experiment& experiment, const constraints::Constraint& constraint,
                                    Criterion criterion, const PredictOptions& options = {});
/// Compiles the constraint first.
std::unique_ptr<Prediction> predict(const experiment::Experiment& experiment, Criterion criterion, const PredictOptions& options = {});

}  // namespace reachlab::predict
