#pragma once
#include <vector>

#include "analysis/study.h"

namespace reachlab::analysis {

/// Enters one trial into its condition's counts.
void countTrial(const StudyTrial& trial, ConditionResult& result);

}  // namespace reachlab::analysis
