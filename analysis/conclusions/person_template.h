#pragma once
#include <span>
#include <vector>

#include "analysis/conclusions/movement_fit.h"

namespace reachlab::analysis {

/// A person's own movement in one condition: the mean of the trials after each was shifted, stretched and scaled onto it, and how much the
/// trials scatter about it at every phase. It weighs the samples for all candidates alike, and says how well anything can describe
/// these trials.
struct PersonTemplate {
  Profile mean;                           // [m/s], over s; `change` empty
  std::vector<double> scatter;            // sigma(s) [m/s] on the grid of `mean`, smoothed
  std::vector<MovementFit> place;         // of each trial on `mean`; amplitudes have mean 1, durations the trials' own
  std::vector<std::vector<float>> apart;  // [m/s] each trial's residual on the grid of `mean`, 0 where it has no samples
  double ceiling = 0;                     // R^2 of the mean of the other trials, over all trials
  double ceilingScore = 0;                // its mean score, ln S
  double effectiveSamples = 1;            // of a trial: samples / sum of squared autocorrelations of the residuals
};

/// Three rounds of aligning and averaging, started from the moments of v^2; then w(s) = 1 / max(sigma(s), 0.1 max sigma), whose square is
/// written into every window's weights. `durations` [s] is what the trials last by the onset rule: it fixes what s = 0 … 1 means. Two
/// trials or more. `apart`, 2 kB a trial, is left empty unless asked for.
PersonTemplate makeTemplate(std::span<FitWindow> windows, std::span<const double> durations, bool keepApart = false);

}  // namespace reachlab::analysis
