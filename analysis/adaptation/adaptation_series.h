#pragma once
#include <optional>
#include <string>
#include <vector>

namespace reachlab::analysis {

/// The trials of one person in order, in any one unit.
struct AdaptationTrial {
  std::optional<double> perturbation;  // none: a channel trial, which clamps the error to zero
  std::optional<double> response;      // how far the person compensates in this trial, before its error is learned; none: not measured
};
using AdaptationSeries = std::vector<AdaptationTrial>;

/// Columns `perturbation` (empty in channel trials) and `response` (empty where it is not known) of a CSV file. Throws FaultError.
AdaptationSeries readAdaptationSeries(const std::string& file);

}  // namespace reachlab::analysis
