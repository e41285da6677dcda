#pragma once
#include <optional>

#include "analysis/conclusions/movement_fit.h"
#include "analysis/measures/measures.h"

namespace reachlab::analysis {

/// The part of a trial that every candidate is compared with, at about 100 samples per second, with weights 1. It begins 0.3 s before the
/// hand's velocity first exceeds 5 % of its peak. It ends 50 ms before the record does, since the filter has only one side there. The
/// recording alone decides it, not the onset rule or the candidates. nullopt: nothing moved along the path, or fewer than ten samples.
std::optional<FitWindow> makeFitWindow(const TrialData& trial, const TrialSignals& signals);

}  // namespace reachlab::analysis
