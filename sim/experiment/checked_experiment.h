#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "constraints/constraint_spec.h"
#include "sim/experiment/experiment_fwd.h"
#include "sim/experiment/task.h"

namespace reachlab::experiment {

inline constexpr double kMaxDuration = 3600, kMaxTimeout = 86400, kMaxRestDuration = 60;  // [s]

/// What holds of an experiment as a value, from a file or from an editor alike: its faults, each under its key, and the constraint, compiled
/// on the way, unless it is at fault itself.
struct CheckedExperiment {
  std::vector<Fault> faults;
  std::shared_ptr<const constraints::Constraint> constraint;
};
/// `compiled`: the experiment's constraint, where somebody has it; compiled here otherwise.
CheckedExperiment check(const Experiment& experiment, const constraints::Constraint* compiled = nullptr);

/// What a file says, whether or not it holds as a value: nothing is compiled. For one that was recorded, and so held when it was.
/// Throws FaultError where the file itself is at fault. `definition`: see parseExperiment.
Experiment readUnchecked(const std::string& text, const std::string& file, const std::string& definition = {});

/// The task, which a trial needs. Throws FaultError without one.
const Task& requiredTask(const Experiment& experiment);

/// Where the task moves a typed formula on: the hull of start and target, when both are there.
std::optional<std::array<constraints::Domain, 2>> placesInUse(const std::optional<Task>& task);

const std::vector<std::string>& methodNames();
const std::vector<std::string>& velocityEstimatorNames();

}  // namespace reachlab::experiment
