#pragma once
#include <string>
#include <vector>

#include "sim/experiment/experiment_fwd.h"

namespace reachlab::analysis {

/// What `other` has and `first` has not, in words with unit, in the order of an experiment file: "duration 1.5 s", "masses 5 x 0.6 kg",
/// "no coupling". Empty when they ask the same, however their files are written.
std::vector<std::string> differences(const experiment::Experiment& first, const experiment::Experiment& other);

}  // namespace reachlab::analysis
