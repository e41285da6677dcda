#pragma once
#include <span>
#include <string>
#include <vector>

#include "analysis/measures/measures.h"
#include "sim/predict/predict.h"

namespace reachlab::analysis {

/// A prediction as if it had been recorded: the hand through the same filter, at rest before and after. Jumps of the hand at the ends
/// (criteria 4 and 6, criterion 5 without a hand mass) are numbers of the prediction, not part of its velocity, and stay out.
struct PredictedSignal {
  predict::Criterion criterion{};
  double plannedDuration = 0;         // [s] T it was predicted for
  double rate = 0;                    // [Hz]
  double begin = 0;                   // [s] where in the signals the movement begins: t = 0
  std::vector<double> hand, object;   // [m/s] along the path, T and some rest on either side
  double onset = 0;                   // [s] by the rule that is used for trials, since the beginning of the signals
  double peak = 0;                    // [m/s] of the hand's speed
  std::vector<std::string> warnings;  // of the prediction
};

/// `options` as for the trials; for OnsetRule::Task the movement begins where the hand has moved `task.onset`.
PredictedSignal recordPrediction(const predict::Prediction& prediction, const MeasureOptions& options, const experiment::Task& task);

/// [s] from the prediction's onset to where the hand's speed last falls below `endLevel` of its peak: where a trial's speed stood at its
/// end, be that the rule's threshold, or higher because every mass was judged to have arrived while the hand still moved.
double durationUntil(const PredictedSignal& signal, double endLevel);

/// One trial's velocities at 101 instants from onset to end, as they were measured.
struct TrialProfile {
  std::vector<double> hand, object;  // [m/s]
  double duration = 0;               // [s]
  double endLevel = 0;               // hand's speed at the end, as a part of its peak
};
TrialProfile makeTrialProfile(const TrialData& trial, const TrialSignals& signals);

/// The paper's epsilon of one trial (sec. 5): sqrt(1/N sum (v_pred - v_exp)^2) over 101 instants. The trial is time-scaled to the
/// prediction (its velocities keep the distance), never the other way round, and both are compared from onset to the same phase. [m/s]
/// Of a series it is the root of the mean of the trials' squares: all have as many samples. NaN without a movement.
struct PaperError {
  double hand = 0, object = 0;
};
PaperError computePaperError(const TrialProfile& trial, const PredictedSignal& predicted);

/// The paper's formula itself. Both of the same length; NaN for none.
double computeRmsError(std::span<const double> predicted, std::span<const double> measured);

}  // namespace reachlab::analysis
