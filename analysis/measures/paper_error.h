#pragma once
#include <memory>
#include <string>
#include <vector>

#include "analysis/measures/measures.h"
#include "sim/predict/predict.h"

namespace reachlab::analysis {

/// A prediction as if it had been recorded: the hand through the same filter, at rest before and after. Jumps of the hand at the ends stay
/// out, since they are separate numbers of the prediction (criteria 4 and 6, criterion 5 without a hand mass).
struct PredictedSignal {
  predict::Criterion criterion{};
  double plannedDuration = 0;                             // [s] T it was predicted for
  double rate = 0;                                        // [Hz]
  double begin = 0;                                       // [s] where in the signals the movement begins: t = 0
  std::vector<double> hand, object;                       // [m/s] along the path, T and some rest on either side
  double onset = 0;                                       // [s] by the rule that is used for trials, since the beginning of the signals
  double peak = 0;                                        // [m/s] of the hand's speed
  std::vector<std::string> warnings;                      // of the prediction
  std::unique_ptr<const predict::Prediction> prediction;  // where it is kept
};

/// `options` are those of the trials. With OnsetRule::Task the movement begins when the hand has moved `task.onset`.
PredictedSignal recordPrediction(const predict::Prediction& prediction, const MeasureOptions& options, const experiment::Task& task);

/// [s] from the prediction's onset to the moment when the hand's speed last falls below `endLevel` of its peak. `endLevel` is the level
/// that a trial's speed had at its end. It may be above the rule's threshold, since every mass can have arrived while the hand still
/// moves.
double durationUntil(const PredictedSignal& signal, double endLevel);

/// One trial's velocities at 101 instants from onset to end, as they were measured.
struct TrialProfile {
  std::vector<double> hand, object;  // [m/s]
  double duration = 0;               // [s]
  double endLevel = 0;               // hand's speed at the end, as a part of its peak
};
TrialProfile makeTrialProfile(const TrialData& trial, const TrialSignals& signals);

/// The paper's epsilon of one trial (sec. 5): sqrt(1/N sum (v_pred - v_exp)^2) over 101 instants. The trial is time-scaled to the
/// prediction, never the prediction to the trial, and its velocities keep the distance. Both are compared from onset to the same phase.
/// [m/s] The error of a series is the root of the mean of the trials' squares, since every trial has 101 samples. NaN without a movement.
struct PaperError {
  double hand = 0, object = 0;
};
PaperError computePaperError(const TrialProfile& trial, const PredictedSignal& predicted);

}  // namespace reachlab::analysis
