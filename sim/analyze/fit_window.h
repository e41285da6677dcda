#pragma once
#include <optional>

#include "sim/analyze/measures.h"
#include "sim/analyze/movement_fit.h"

namespace reachlab::analyze {

/// What every candidate is compared with: from 0.3 s before the hand's velocity first exceeds 5 % of its peak to 50 ms before the record
/// ends (there the filter has only one side), at about 100 samples a second, weights 1. The recording alone decides it, whatever the onset
/// rule and the candidates. nullopt: nothing moved along the path, or fewer than ten samples.
std::optional<FitWindow> makeFitWindow(const TrialData& trial, const TrialSignals& signals);

}  // namespace reachlab::analyze
