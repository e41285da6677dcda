#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/measures/statistics.h"

/// Trial-by-trial learning as one or two linear states (Smith, Ghazizadeh & Shadmehr 2006, PLoS Biology 4:e179). Pure functions for any
/// thread.
///
///     e(n) = p(n) - x(n), and e(n) = 0 in a channel;   x = x_f + x_s;   x_k(n + 1) = A_k x_k(n) + B_k e(n)
///
/// x(n) is the response in trial n, before the error of that trial is learned. x(1) = 0.
namespace reachlab::analysis {

/// The trials of one person in order, in any one unit.
struct AdaptationTrial {
  std::optional<double> perturbation;  // none: a channel trial, which clamps the error to zero
  std::optional<double> response;      // how far the person compensates in this trial, before its error is learned; none: not measured
};
using AdaptationSeries = std::vector<AdaptationTrial>;

/// Columns `perturbation` (empty in channel trials) and `response` (empty where it is not known) of a CSV file. Throws FaultError.
AdaptationSeries readAdaptationSeries(const std::string& file);

/// The share of a state that is kept from one trial to the next, and the share of an error that is learned. Both are from 0 to 1.
struct LearningState {
  double retention = 0;     // A
  double learningRate = 0;  // B
};

/// x of every trial. The states are added: a single state, or a fast and a slow state.
std::vector<double> simulateLearning(const std::vector<LearningState>& states, const AdaptationSeries& series);

struct LearningFit {
  std::vector<LearningState> states;             // fast, slow; or the single one
  double meanSquare = 0;                         // of the residuals, in the square of the responses' unit
  double bic = 0;                                // Bayesian information criterion: n ln(mean square) + k ln n
  std::vector<std::array<Bounds, 2>> intervals;  // of each state's retention and learning rate: 95 %
};

/// The number of states by the series. Undecided: the criteria differ by less than 6 (Kass & Raftery 1995: less than strong).
enum class StateCount { One, Two, Undecided };

struct AdaptationFit {
  LearningFit one, two;
  StateCount count = StateCount::Undecided;
  std::size_t responses = 0, channels = 0;  // measured responses; channel trials
};

/// Least squares within 0 <= A_f <= A_s <= 1 and 0 <= B_s <= B_f <= 1, from several starts. The intervals come from `resamples` bootstrap
/// series whose residuals are drawn in blocks of neighbouring trials, which keeps slow drifts together. Throws RefusedError where nothing
/// is perturbed, fewer than 12 responses are measured, which is three for each parameter of two states, there are more than 10,000 trials,
/// or the squares of the numbers go beyond a double.
AdaptationFit fitAdaptation(const AdaptationSeries& series, int resamples, std::uint64_t seed);

}  // namespace reachlab::analysis
