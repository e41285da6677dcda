#pragma once
#include <string>
#include <vector>

#include "sim/analyze/measures.h"
#include "sim/predict/predict.h"

namespace reachlab::analyze {

/// A prediction as if it had been recorded: the hand through the same filter, at rest before and after. Jumps of the hand at the ends
/// (criteria 4 and 6, criterion 5 without a hand mass) are numbers of the prediction, not part of its velocity, and stay out.
struct PredictedSignal {
  predict::Criterion criterion{};
  double taskDuration = 0;            // [s] T it was predicted for
  double rate = 0;                    // [Hz]
  std::vector<double> hand, object;   // [m/s] along the path
  double onset = 0;                   // [s] by the rule that is used for trials
  double peak = 0;                    // [m/s] of the hand's speed
  std::vector<std::string> warnings;  // of the prediction
};

/// `options` as for the trials; for OnsetRule::Task the movement begins where the hand has moved `task.onset`.
PredictedSignal recordPrediction(const predict::Prediction& prediction, const MeasureOptions& options, const experiment::Task& task);

/// From onset to the end, 101 instants.
struct PredictedProfile {
  predict::Criterion criterion{};
  double taskDuration = 0;           // [s] T it was predicted for
  double duration = 0;               // [s] onset to end
  std::vector<double> hand, object;  // [m/s] along the path, at 0 … 100 % of `duration`
  std::vector<std::string> warnings;
};

/// The movement ends where the hand's speed last falls below `endLevel` of its peak: where a trial's speed stood at its end, be that the
/// rule's threshold, or higher because every mass was judged to have arrived while the hand still moved. So both are cut at the same
/// phase, whenever the judge's tolerances let the trial end.
PredictedProfile profileUntil(const PredictedSignal& signal, double endLevel);

/// Time-scaled to `duration` like a trial: velocities keep the distance.
PredictedProfile scaledTo(PredictedProfile profile, double duration);

}  // namespace reachlab::analyze
