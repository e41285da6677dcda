#pragma once
#include <span>
#include <vector>

#include "analysis/conclusions/movement_fit.h"

namespace reachlab::analysis {

/// A person's own mean movement in one condition, and how much the trials scatter about it at every phase. Each trial is shifted, stretched
/// and scaled onto the mean. The scatter weighs the samples for all candidates alike. The mean also tells how well any profile can describe
/// these trials.
struct PersonTemplate {
  Profile mean;                           // [m/s], over s; `change` empty
  std::vector<double> scatter;            // sigma(s) [m/s] on the grid of `mean`, smoothed
  std::vector<MovementFit> place;         // of each trial on `mean`; amplitudes have mean 1, durations the trials' own
  std::vector<std::vector<float>> apart;  // [m/s] each trial's residual on the grid of `mean`, 0 where it has no samples
  double ceiling = 0;                     // R^2 of the mean of the other trials, over all trials
  /// ln S of each trial for the mean of the other trials, or for the line through the other trials over ln T at every phase. The line lets the
  /// shape change with the duration. The description with the lower mean score is used for all trials.
  std::vector<double> score;
  double ceilingScore = 0;      // mean of `score`
  double effectiveSamples = 1;  // of a trial: samples / sum of squared autocorrelations of the residuals
};

/// Three rounds of aligning and averaging, started from the moments of v^2. The square of w(s) = 1 / max(sigma(s), 0.1 max sigma) is then
/// written into every window's weights. `durations` [s] are the trials' durations by the onset rule, which set s = 0 and s = 1. Two trials
/// or more. `apart`, 2 kB per trial, is filled only if `keepApart` is true.
PersonTemplate makeTemplate(std::span<FitWindow> windows, std::span<const double> durations, bool keepApart = false);

/// Writes those weights into the window of trial number `trial` again.
void weigh(FitWindow& window, const PersonTemplate& own, std::size_t trial);

}  // namespace reachlab::analysis
