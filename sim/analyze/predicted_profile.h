#pragma once
#include <string>
#include <vector>

#include "sim/analyze/measures.h"
#include "sim/predict/predict.h"

namespace reachlab {

/// A prediction put through the same measurement as a trial: the hand through the same filter, at rest before and after; onset and offset
/// by the same rule; 101 instants between them. Jumps of the hand at the ends (criteria 4 and 6, criterion 5 without a hand mass) are
/// numbers of the prediction, not part of its velocity, and stay out.
struct PredictedProfile {
  Criterion criterion{};
  double taskDuration = 0;             // [s] T it was predicted for
  double duration = 0;                 // [s] onset to offset by the rule
  std::vector<double> hand, object;    // [m/s] along the path, at 0 … 100 % of `duration`
  std::vector<std::string> warnings;   // of the prediction
};

/// `options` as for the trials; for OnsetRule::Task the movement lasts from `taskOnset` [m] moved until T.
PredictedProfile sampleProfile(const Prediction& prediction, const MeasureOptions& options, double taskOnset);

/// Time-scaled to `duration` like a trial: velocities keep the distance.
PredictedProfile scaledTo(PredictedProfile profile, double duration);

}  // namespace reachlab
