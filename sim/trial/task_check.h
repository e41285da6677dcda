#pragma once
#include <string>
#include <vector>

#include "sim/experiment/experiment.h"

namespace reachlab::trial {

/// Whether the experiment's task can be carried out as a reach: start and target on the constraint, and not the same place. Asked before
/// a run and by `reach validate`; who only simulates or predicts has rules of his own. Throws UsageError naming `file`.
void checkTask(const experiment::Experiment& experiment, const std::string& file);

/// Numbers that are allowed but hardly meant, one sentence each: a tolerance larger than the way, more than a minute, more than 100 kg.
std::vector<std::string> implausibleNumbers(const experiment::Experiment& experiment, const std::string& file);

}  // namespace reachlab::trial
