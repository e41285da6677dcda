#pragma once
#include <span>
#include <vector>

#include "analysis/conclusions/movement_fit.h"

namespace reachlab::analysis {

/// The part of a person's residuals that is the same in every trial, or grows with the duration: a test of a fit by its mean residual. Under the
/// hypothesis that the fit is right, a trial's residual is as likely with the other sign.
struct SystematicRest {
  double share = 0;                // of the mean squared residual. About 0 for a right fit, where it may be negative
  double variance = 0, third = 0;  // second and third cumulant of `share` over all choices of the signs
  /// The chance of so large a share if the fit is right. 1 if nothing was tested. The distribution over the signs is taken as a shifted gamma
  /// distribution with its three cumulants.
  double p() const;
};

/// One row per trial: its weighted residual on the phases at which trials are laid over one another.
using LaidResiduals = std::vector<std::vector<double>>;

/// Residuals of the trials in their order, laid over one another by phase and weighed, and the trials' durations [s].
/// With r_i the residuals, x_i the standardised ln T, and the sums over pairs of trials that are no neighbours, share is
///   sum (1 + x_i x_j) r_i . r_j / sum 1 / mean |r_i|^2
/// Neighbours are left out because trials that follow one another are alike. Long series are judged by means of consecutive trials.
SystematicRest computeSystematicRest(LaidResiduals residuals, std::vector<double> durations);

/// `place`: of the trial on the person's mean. The residual is weighed by the window's weights.
std::vector<double> layResidual(const FitWindow& window, std::span<const double> residual, const MovementFit& place);

/// The position of each trial on the way from a fit to every other fit, [fit][trial]: 0 at the first fit, 1 at the second fit, 0.5 for their mean. The
/// way is the mean over the remaining trials, so that a trial's own scatter does not choose it. 0 where both fits are the same.
std::vector<std::vector<double>> computeSharesOfOthers(std::span<const LaidResiduals> fits, std::size_t of);

/// The mean of independent tests, for example of a person's conditions or of several people.
SystematicRest meanOf(std::span<const SystematicRest> rests);

}  // namespace reachlab::analysis
