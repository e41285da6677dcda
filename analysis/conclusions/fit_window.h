#pragma once
#include <optional>

#include "analysis/conclusions/movement_fit.h"
#include "analysis/measures/measures.h"

namespace reachlab::analysis {

/// What every candidate is compared with: from 0.3 s before the hand's velocity first exceeds 5 % of its peak to 50 ms before the record
/// ends (there the filter has only one side), at about 100 samples a second, weights 1. The recording alone decides it, whatever the onset
/// rule and the candidates. nullopt: nothing moved along the path, or fewer than ten samples.
std::optional<FitWindow> makeFitWindow(const TrialData& trial, const TrialSignals& signals);

}  // namespace reachlab::analysis
