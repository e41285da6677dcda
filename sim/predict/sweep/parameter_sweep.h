#pragma once
#include <functional>
#include <string>
#include <vector>

#include "sim/predict/predict.h"

namespace reachlab::predict {

/// How a hand profile looks: interior maxima of the velocity, and whether the hand moves backwards somewhere. Ripples below 1e-9
/// of the peak do not count.
struct ProfileShape {
  int velocityPeaks = 0;
  bool reverses = false;
};
ProfileShape computeShape(const Prediction& prediction);

/// One parameter from `from` to `to` in steps, both ends included (to half a step).
struct Sweep {
  std::string key;
  double from = 0, to = 0, step = 0;
  std::vector<double> values() const;
};
/// Parses KEY=FROM:TO:STEP. Throws FaultError of the key `sweep`.
Sweep parseSweep(const std::string& text);
struct SweepKey {
  std::string_view name, meaning;
  std::string_view needs;  // what the object must have, as each row would be the same otherwise: empty, or the words of the refusal
  void (*set)(double value, experiment::Experiment& experiment, PredictOptions& options);
};
std::span<const SweepKey> sweepKeys();
/// Sets one key of experiment or options. Throws FaultError for a value that makes no sense for this object.
void applySweepValue(const std::string& key, double value, experiment::Experiment& experiment, PredictOptions& options);

struct SweepRow {
  double value = 0;
  std::unique_ptr<Prediction> prediction;  // null when refused
  ProfileShape shape;
  std::string refusal;
};
/// Predictions for every value of the sweep, on all cores. `progress` (may be empty) is called after each value with the number that is
/// done. The calls come from any of the threads, one at a time.
std::vector<SweepRow> computeSweep(const experiment::CompiledExperiment& experiment, Criterion criterion, const PredictOptions& options,
                                   const Sweep& sweep, const std::function<void(int done, int total)>& progress = {});

}  // namespace reachlab::predict
