#pragma once
#include <vector>

#include "sim/analyze/study.h"

namespace reachlab::analyze {

/// Enters one trial into its condition's counts.
void countTrial(const StudyTrial& trial, ConditionResult& result);

}  // namespace reachlab::analyze
