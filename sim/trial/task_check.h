#pragma once
#include <string>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::trial {

/// Reasons why the task cannot be carried out as a reach. Start and target must be two different places on the constraint. Checked before a
/// run and by `reach validate`. Simulations and predictions have other rules.
std::vector<Fault> taskProblems(const experiment::CompiledExperiment& experiment);
/// Throws these as FaultError, with their places in `file`.
void checkTask(const experiment::CompiledExperiment& experiment, const std::string& file);

/// Numbers that are allowed but hardly meant: a tolerance larger than the way, more than a minute, more than 100 kg.
std::vector<Fault> implausibleNumbers(const experiment::CompiledExperiment& experiment);

}  // namespace reachlab::trial
