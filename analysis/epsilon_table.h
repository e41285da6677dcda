#pragma once
#include <span>

#include "analysis/analysis.h"

namespace reachlab::analysis {

/// The paper's epsilon of each criterion over the trials of one condition, hand or object: over all samples, with intervals over people.
/// It describes the movements. Conclusions come from the fits.
EpsilonTable makeEpsilonTable(std::span<const AnalyzedTrial> trials, std::size_t criteria, bool object);

}  // namespace reachlab::analysis
