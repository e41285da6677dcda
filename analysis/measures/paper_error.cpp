#include "analysis/measures/paper_error.h"

#include <algorithm>
#include <cmath>

#include "analysis/measures/filter.h"
#include "analysis/measures/movement.h"
#include "sim/experiment/task.h"

namespace reachlab::analysis {

PredictedSignal recordPrediction(const predict::Prediction& prediction, const MeasureOptions& options, const experiment::Task& task) {
  constexpr double kRate = 1000;      // [Hz] fine enough that its own interpolation does not show (1e-6 of the peak)
  constexpr std::size_t kRest = 300;  // samples of rest on either side, in which the filter dies out
  const double T = prediction.duration;
  const auto steps = static_cast<std::size_t>(std::max(2.0, std::ceil(T * kRate)));

  PredictedSignal signal;
  signal.criterion = prediction.criterion;
  signal.plannedDuration = T;
  signal.warnings = prediction.warnings;
  signal.rate = static_cast<double>(steps) / T;
  signal.begin = static_cast<double>(kRest) / signal.rate;
  signal.hand.assign(steps + 1 + 2 * kRest, 0.0);
  signal.object = signal.hand;
  std::size_t moved = steps;
  for (std::size_t i = steps + 1; i-- > 0;) {
    const double t = std::min(T, static_cast<double>(i) / signal.rate);
    const predict::PredictedHand at = prediction.handAt(t);
    signal.hand[i + kRest] = at.velocity;
    signal.object[i + kRest] = prediction.objectVelocityAt(t);
    if (std::abs(at.position) > task.onset) moved = i;
  }
  signal.hand = lowPass(signal.hand, signal.rate, options.cutoff);
  std::vector<double> speed = signal.hand;
  for (double& v : speed) v = std::abs(v);
  signal.peak = *std::max_element(speed.begin(), speed.end());
  signal.onset = options.onset.rule == OnsetRule::Task ? static_cast<double>(moved + kRest) / signal.rate
                                                       : findMovement(speed, signal.rate, options.onset).onset;
  return signal;
}

double durationUntil(const PredictedSignal& signal, double endLevel) {
  const double threshold = std::clamp(endLevel, 0.0, 0.999) * signal.peak;
  std::size_t last = signal.hand.size() - 1;
  while (last > 0 && std::abs(signal.hand[last]) <= threshold) --last;
  double end = static_cast<double>(last) / signal.rate;
  if (last + 1 < signal.hand.size()) {
    const double above = std::abs(signal.hand[last]), below = std::abs(signal.hand[last + 1]);
    if (above > below) end += (above - threshold) / (above - below) / signal.rate;
  }
  return std::max(end - signal.onset, 1 / signal.rate);
}

TrialProfile makeTrialProfile(const TrialData& trial, const TrialSignals& signals) {
  TrialProfile out;
  const Movement& move = signals.movement;
  if (!move.found) return out;
  out.hand = normaliseTime(signals.handVelocity, trial.rate, move.onset, move.offset);
  out.object = normaliseTime(signals.objectVelocity, trial.rate, move.onset, move.offset);
  out.duration = move.duration();
  out.endLevel = valueAt(signals.speed, trial.rate, move.offset) / move.peak;
  return out;
}

PaperError computePaperError(const TrialProfile& trial, const PredictedSignal& predicted) {
  if (trial.hand.empty()) return {kNotMeasured, kNotMeasured};
  const double duration = durationUntil(predicted, trial.endLevel), scale = trial.duration / duration;
  const auto error = [&](const std::vector<double>& signal, std::vector<double> measured) {
    for (double& v : measured) v *= scale;
    const std::vector<double> wanted = normaliseTime(signal, predicted.rate, predicted.onset, predicted.onset + duration);
    double sum = 0;
    for (std::size_t i = 0; i < kProfilePoints; ++i) sum += (wanted[i] - measured[i]) * (wanted[i] - measured[i]);
    return std::sqrt(sum / static_cast<double>(kProfilePoints));
  };
  return {error(predicted.hand, trial.hand), error(predicted.object, trial.object)};
}

}  // namespace reachlab::analysis
