#pragma once
#include <vector>

#include "analysis/analysis.h"

namespace reachlab::analysis {

/// Enters one trial into its condition's counts.
void countTrial(const AnalyzedTrial& trial, ConditionResult& result);

}  // namespace reachlab::analysis
