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

/// The faults of an experiment, each under its key as in the files, and its constraint. The constraint is missing if it is at fault itself.
struct CheckedExperiment {
  std::vector<Fault> faults;
  std::shared_ptr<const constraints::Constraint> constraint;
};
/// `compiled`: the experiment's constraint, if the caller has it. Otherwise it is compiled here.
CheckedExperiment check(const Experiment& experiment, const constraints::Constraint* compiled = nullptr);

/// Reads a file without checking its values or compiling. For recorded experiments, which were checked before their run.
/// Throws FaultError if the file cannot be read as an experiment. `definition`: see parseExperiment.
Experiment readUnchecked(const std::string& text, const std::string& file, const std::string& definition = {});

/// The task, which a trial needs. Throws FaultError if the experiment has no task.
const Task& requiredTask(const Experiment& experiment);

/// Where the task moves a typed formula on: the hull of start and target, when both are there.
std::optional<std::array<constraints::Domain, 2>> placesInUse(const std::optional<Task>& task);

const std::vector<std::string>& methodNames();
const std::vector<std::string>& velocityEstimatorNames();

}  // namespace reachlab::experiment
