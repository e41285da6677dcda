#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/steps.h"
#include "base/error.h"
#include "sim/experiment/experiment.h"

namespace reachlab::analysis {
namespace {

predict::PredictOptions howOf(const AnalysisOptions& options) {
  predict::PredictOptions how;
  how.handMass = options.handMass;
  how.handDamping = options.handDamping;
  return how;
}

PredictedSignal predicted(const Condition& condition, predict::Criterion criterion, const predict::PredictOptions& how,
                          const AnalysisOptions& options) {
  std::unique_ptr<predict::Prediction> prediction = predict::predict(condition.compiled, criterion, how);
  PredictedSignal signal = recordPrediction(*prediction, options.measure, *condition.experiment().task);
  signal.prediction = std::move(prediction);
  return signal;
}

/// The prediction whose movement, measured like a trial's, lasts `measured`: fixed-point steps on its duration.
PredictedSignal predictLasting(const Condition& condition, predict::Criterion criterion, predict::PredictOptions how,
                               const AnalysisOptions& options, const ConditionResult& result) {
  how.duration = condition.experiment().task->duration;
  PredictedSignal signal;
  for (int step = 0; step < 8; ++step) {
    signal = predicted(condition, criterion, how, options);
    const double ratio = result.duration.mean / durationUntil(signal, result.endLevel);
    if (std::abs(ratio - 1) < 1e-6) break;
    how.duration *= ratio;
  }
  return signal;
}

void addPredictions(const Condition& condition, const AnalysisOptions& options, ConditionResult& result) {
  if (!condition.experiment().task) {
    result.refusals.push_back("the experiment has no task to predict");
    return;
  }
  const predict::PredictOptions how = howOf(options);
  for (const predict::Criterion criterion : options.drawn.empty() ? predict::orAll(options.criteria) : options.drawn) {
    if (!holdsFor(condition, criterion)) {
      result.refusals.push_back(
          fmt::format("{}: it differs between directions, and the trials to several targets are taken together", nameOf(criterion)));
      continue;
    }
    try {
      result.signals.push_back(options.predictFor == PredictionDuration::Moved && result.used > 0
                                   ? predictLasting(condition, criterion, how, options, result)
                                   : predicted(condition, criterion, how, options));
    } catch (const Error& error) {
      const std::string what = error.what();
      result.refusals.push_back(what.starts_with(nameOf(criterion)) ? what : fmt::format("{}: {}", nameOf(criterion), what));
    }
  }
}

/// The paper's Figs. 9 and 10 are also shown with criterion (1) for the duration that was moved.
void addMoved(const Condition& condition, const AnalysisOptions& options, ConditionResult& result) {
  constexpr predict::Criterion kShown = predict::Criterion::MinHandJerk;
  if (!result.predicts(kShown) || result.used == 0 || options.predictFor == PredictionDuration::Moved) return;
  try {
    result.moved = predictLasting(condition, kShown, howOf(options), options, result);
  } catch (const Error& error) {
    result.refusals.push_back(fmt::format("{} for the duration that was moved: {}", nameOf(kShown), error.what()));
  }
}

/// Welford's running mean and sum of squares, a point each.
struct RunningProfile {
  std::vector<double> mean = std::vector<double>(kProfilePoints, 0.0), squares = mean;
  double count = 0;
  void add(const std::vector<double>& profile, double factor) {
    count += 1;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const double apart = factor * profile[i] - mean[i];
      mean[i] += apart / count;
      squares[i] += apart * (factor * profile[i] - mean[i]);
    }
  }
  MeanProfile result() const {
    MeanProfile out;
    if (count == 0) return out;
    out.mean = mean;
    for (const double s : squares) out.sd.push_back(count > 1 ? std::sqrt(s / (count - 1)) : kNotMeasured);
    return out;
  }
};

}  // namespace

bool ConditionResult::predicts(predict::Criterion criterion) const {
  return std::any_of(signals.begin(), signals.end(), [&](const PredictedSignal& s) { return s.criterion == criterion; });
}

void summarise(Analysis& analysis, std::size_t condition) {
  ConditionResult& result = analysis.results[condition];
  const std::span<AnalyzedTrial> trials = trialsOf(analysis, condition);
  std::vector<double> durations, times, levels;
  for (const AnalyzedTrial& trial : trials) {
    if (!trial.used()) continue;
    durations.push_back(trial.measures.duration);
    times.push_back(trial.measures.movementTime);
    levels.push_back(trial.endLevel);
  }
  result.used = durations.size();
  result.endLevel = levels.empty() ? analysis.options.measure.onset.percent / 100 : computeMeanSd(levels).mean;
  result.duration = computeMeanSd(durations);
  result.movementTime = computeMeanSd(times);
  if (!times.empty()) result.movementRange = {*std::min_element(times.begin(), times.end()), *std::max_element(times.begin(), times.end())};
  addPredictions(analysis.conditions[condition], analysis.options, result);
  addMoved(analysis.conditions[condition], analysis.options, result);
  RunningProfile hand, object;
  for (AnalyzedTrial& trial : trials) {
    if (!trial.used()) continue;
    const TrialProfile profile = analysis.profileOf(trial);
    hand.add(profile.hand, profile.duration / result.duration.mean);
    object.add(profile.object, profile.duration / result.duration.mean);
    const std::size_t criteria = result.signals.size();
    trial.paperError.resize(2 * criteria);
    for (std::size_t c = 0; c < criteria; ++c) {
      const PaperError error = computePaperError(profile, result.signals[c]);
      trial.paperError[c] = error.hand;
      trial.paperError[criteria + c] = error.object;
    }
  }
  result.hand = hand.result();
  result.object = object.result();
  result.handEpsilon = makeEpsilonTable(trials, result.signals.size(), false);
  result.objectEpsilon = makeEpsilonTable(trials, result.signals.size(), true);
}

bool holdsFor(const Condition& condition, predict::Criterion criterion) {
  return !condition.pooled || criterion != predict::Criterion::MinTorqueChange;
}

std::span<AnalyzedTrial> trialsOf(Analysis& analysis, std::size_t condition) {
  const auto first =
      std::find_if(analysis.trials.begin(), analysis.trials.end(), [&](const AnalyzedTrial& t) { return t.condition >= condition; });
  const auto last = std::find_if(first, analysis.trials.end(), [&](const AnalyzedTrial& t) { return t.condition > condition; });
  return {first, last};
}

}  // namespace reachlab::analysis
