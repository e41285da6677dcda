#pragma once
#include <string>
#include <vector>

#include "sim/experiment/experiment_fwd.h"

namespace reachlab::analysis {

/// The values of `other` that differ from `first`, as texts with unit, in the order of an experiment file. Examples are "duration 1.5 s",
/// "masses 5 x 0.6 kg" and "no coupling". Empty for equal experiments, however their files are written.
std::vector<std::string> differences(const experiment::Experiment& first, const experiment::Experiment& other);
/// The same for tasks that may have another start and target, which are not compared.
std::vector<std::string> differencesBesideDirection(const experiment::Experiment& first, const experiment::Experiment& other);
/// The tasks are one movement in several directions: free space, equal distances and no gravity on an object, and nothing else differs.
bool differInDirectionOnly(const experiment::Experiment& first, const experiment::Experiment& other);

}  // namespace reachlab::analysis
