#include "sim/analyze/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "base/error.h"
#include "sim/analyze/counts.h"

namespace reachlab::analyze {
namespace {

auto orderOf(const StudyTrial& t) { return std::tie(t.condition, t.key.subject, t.key.session, t.key.run, t.key.trial); }

std::string whyExcluded(const StudyTrial& trial, bool catchTrial, const Movement& movement, bool includePractice) {
  if (catchTrial) return "catch trial";
  if (trial.practice && !includePractice) return "practice";
  if (trial.result.outcome != trial::Outcome::Success) return std::string(trial::nameOf(trial.result.outcome));
  if (!movement.found) return "no movement found";
  return {};
}

StudyTrial measureTrial(TrialData& data, std::size_t condition, const StudyOptions& options) {
  StudyTrial trial;
  trial.key = data.key;
  trial.condition = condition;
  trial.result = data.result;
  trial.practice = data.practice;
  const TrialSignals signals = computeSignals(data, options.measure);
  trial.measures = computeMeasures(data, signals);
  trial.exclusion = whyExcluded(trial, data.catchTrial, signals.movement, options.includePractice);
  trial.counted = !data.catchTrial && (!data.practice || options.includePractice) &&
                  (data.result.outcome == trial::Outcome::Success || data.result.outcome == trial::Outcome::Failure);
  if (signals.movement.found) {
    trial.hand = normaliseTime(signals.handVelocity, data.rate, signals.movement.onset, signals.movement.offset);
    trial.object = normaliseTime(signals.objectVelocity, data.rate, signals.movement.onset, signals.movement.offset);
    trial.endLevel = valueAt(signals.speed, data.rate, signals.movement.offset) / signals.movement.peak;
  }
  return trial;
}

/// Where nothing succeeded, the failed movements are still worth looking at; they are shown as such and left out of the overall ranking.
void useFailuresWhereNothingSucceeded(StudyResult& study) {
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const auto ofCondition = [&](const StudyTrial& t) { return t.condition == c; };
    if (std::any_of(study.trials.begin(), study.trials.end(), [&](const StudyTrial& t) { return ofCondition(t) && t.used(); })) continue;
    for (StudyTrial& trial : study.trials) {
      if (!ofCondition(trial) || !trial.counted || trial.hand.empty()) continue;
      --study.results[c].exclusions[trial.exclusion];
      trial.exclusion.clear();
      study.results[c].onlyFailures = true;
    }
    std::erase_if(study.results[c].exclusions, [](const auto& entry) { return entry.second == 0; });
  }
}

std::vector<double> timeScaled(const std::vector<double>& profile, double from, double to) {
  std::vector<double> out = profile;
  for (double& v : out) v *= from / to;
  return out;
}

MeanProfile computeMeanProfile(const std::vector<std::vector<double>>& profiles) {
  MeanProfile out;
  std::vector<double> column(profiles.size());
  for (std::size_t i = 0; i < kProfilePoints && !profiles.empty(); ++i) {
    for (std::size_t k = 0; k < profiles.size(); ++k) column[k] = profiles[k][i];
    const MeanSd at = computeMeanSd(column);
    out.mean.push_back(at.mean);
    out.sd.push_back(at.sd);
  }
  return out;
}

std::vector<predict::Criterion> wantedCriteria(const StudyOptions& options) {
  if (!options.criteria.empty()) return options.criteria;
  std::vector<predict::Criterion> all;
  for (int i = 0; i < predict::kCriterionCount; ++i) all.push_back(static_cast<predict::Criterion>(i));
  return all;
}

/// The prediction whose movement, measured like a trial's, lasts `measured`: fixed-point steps on its duration.
PredictedSignal signalLasting(const StudyCondition& condition, predict::Criterion criterion, predict::PredictOptions how,
                              const StudyOptions& options, const ConditionResult& result) {
  how.duration = condition.experiment.task->duration;
  PredictedSignal signal;
  for (int step = 0; step < 8; ++step) {
    signal = recordPrediction(*predict::predict(condition.experiment, criterion, how), options.measure, *condition.experiment.task);
    const double ratio = result.duration.mean / profileUntil(signal, result.endLevel).duration;
    if (std::abs(ratio - 1) < 1e-6) break;
    how.duration *= ratio;
  }
  return signal;
}

void addPredictions(const StudyCondition& condition, const StudyOptions& options, ConditionResult& result) {
  if (!condition.experiment.task) {
    result.refusals.push_back("the experiment has no task to predict");
    return;
  }
  predict::PredictOptions how;
  how.handMass = options.handMass;
  how.handDamping = options.handDamping;
  for (const predict::Criterion criterion : wantedCriteria(options)) {
    try {
      result.signals.push_back(
          recordPrediction(*predict::predict(condition.experiment, criterion, how), options.measure, *condition.experiment.task));
    } catch (const Error& error) {
      const std::string what = error.what();
      result.refusals.push_back(what.starts_with(predict::nameOf(criterion)) ? what
                                                                             : fmt::format("{}: {}", predict::nameOf(criterion), what));
    }
  }
  if (result.used > 0 && !result.signals.empty()) {
    std::vector<double> ratios;
    for (const PredictedSignal& signal : result.signals)
      ratios.push_back(result.duration.mean / profileUntil(signal, result.endLevel).duration);
    std::sort(ratios.begin(), ratios.end());
    result.durationRatio = quantileOfSorted(ratios, 0.5);
    result.predictedForMoved = options.predictFor == PredictionDuration::Moved ||
                               (options.predictFor == PredictionDuration::Auto && std::abs(result.durationRatio - 1) > kKeptDuration);
  }
  for (PredictedSignal& signal : result.signals) {
    if (result.predictedForMoved) {
      try {
        signal = signalLasting(condition, signal.criterion, how, options, result);
      } catch (const Error& error) {
        result.refusals.push_back(fmt::format("{}: {}; compared at the task's T", predict::nameOf(signal.criterion), error.what()));
      }
    }
    const PredictedProfile profile = profileUntil(signal, result.endLevel);
    result.predictions.push_back(result.used > 0 ? scaledTo(profile, result.duration.mean) : profile);
  }
}

void addErrors(StudyTrial& trial, const ConditionResult& result) {
  if (!trial.used()) return;
  const std::vector<double> hand = timeScaled(trial.hand, trial.measures.duration, result.duration.mean);
  const std::vector<double> object = timeScaled(trial.object, trial.measures.duration, result.duration.mean);
  for (const PredictedSignal& signal : result.signals) {
    const PredictedProfile prediction = scaledTo(profileUntil(signal, trial.endLevel), result.duration.mean);
    trial.handError.push_back(computeRmsError(prediction.hand, hand));
    trial.objectError.push_back(computeRmsError(prediction.object, object));
  }
}

TrialErrors squaresOf(const StudyTrial& trial, const std::vector<double>& errors) {
  TrialErrors out{trial.key.subject, {}, static_cast<double>(kProfilePoints)};
  for (const double e : errors) out.squares.push_back(e * e * static_cast<double>(kProfilePoints));
  return out;
}

void summarise(const std::vector<StudyTrial>& trials, std::size_t condition, const StudyCondition& what, const StudyOptions& options,
               ConditionResult& result) {
  std::vector<double> durations, times, levels;
  for (const StudyTrial& trial : trials) {
    if (trial.condition != condition || !trial.used()) continue;
    durations.push_back(trial.measures.duration);
    times.push_back(trial.measures.movementTime);
    levels.push_back(trial.endLevel);
  }
  result.used = durations.size();
  result.endLevel = levels.empty() ? options.measure.onset.percent / 100 : computeMeanSd(levels).mean;
  result.duration = computeMeanSd(durations);
  result.movementTime = computeMeanSd(times);
  std::vector<std::vector<double>> hand, object;
  for (const StudyTrial& trial : trials) {
    if (trial.condition != condition || !trial.used()) continue;
    hand.push_back(timeScaled(trial.hand, trial.measures.duration, result.duration.mean));
    object.push_back(timeScaled(trial.object, trial.measures.duration, result.duration.mean));
  }
  result.hand = computeMeanProfile(hand);
  result.object = computeMeanProfile(object);
  addPredictions(what, options, result);
}

void rankCondition(const std::vector<StudyTrial>& trials, std::size_t condition, const StudyOptions& options, ConditionResult& result) {
  std::vector<TrialErrors> hand, object;
  for (const StudyTrial& trial : trials) {
    if (trial.condition != condition || !trial.used()) continue;
    hand.push_back(squaresOf(trial, trial.handError));
    object.push_back(squaresOf(trial, trial.objectError));
  }
  result.handRanking = rankOverTrials(hand, options.ranking);
  result.objectRanking = rankOverTrials(object, options.ranking);
  result.handOverSubjects = rankOverSubjects(hand, options.ranking);
  result.objectOverSubjects = rankOverSubjects(object, options.ranking);
}

void rankTogether(StudyResult& study) {
  // Only criteria that every condition with trials has can be compared over all of them.
  bool first = true;
  for (const ConditionResult& result : study.results) {
    if (result.used == 0 || result.onlyFailures) continue;
    std::vector<predict::Criterion> here;
    for (const PredictedProfile& p : result.predictions) here.push_back(p.criterion);
    if (first) study.common = here;
    else std::erase_if(study.common, [&](predict::Criterion c) { return std::find(here.begin(), here.end(), c) == here.end(); });
    first = false;
  }
  std::vector<TrialErrors> all;
  for (const StudyTrial& trial : study.trials) {
    if (!trial.used() || study.results[trial.condition].onlyFailures) continue;
    const auto& predictions = study.results[trial.condition].predictions;
    std::vector<double> errors;
    for (const predict::Criterion c : study.common)
      for (std::size_t k = 0; k < predictions.size(); ++k)
        if (predictions[k].criterion == c) errors.push_back(trial.handError[k]);
    all.push_back(squaresOf(trial, errors));
  }
  study.overall = rankOverTrials(all, study.options.ranking);
  study.overallOverSubjects = rankOverSubjects(all, study.options.ranking);
}

void addSeries(StudyResult& study) {
  const auto sameSeries = [](const StudyTrial& a, const SeriesResult& b) {
    return a.condition == b.condition && a.key.subject == b.key.subject && a.key.session == b.key.session && a.key.run == b.key.run;
  };
  for (const StudyTrial& trial : study.trials) {
    if (!trial.used()) continue;
    if (study.series.empty() || !sameSeries(trial, study.series.back())) {
      SeriesResult series{trial.key, trial.condition, 0, std::vector<double>(trial.handError.size(), 0.0), {}};
      series.key.trial = 0;
      series.objectError = series.handError;
      study.series.push_back(series);
    }
    SeriesResult& series = study.series.back();
    ++series.trials;
    for (std::size_t c = 0; c < trial.handError.size(); ++c) {
      series.handError[c] += trial.handError[c] * trial.handError[c];
      series.objectError[c] += trial.objectError[c] * trial.objectError[c];
    }
  }
  // Every trial has the same number of samples, so the mean of their mean squares is the mean over all samples.
  for (SeriesResult& series : study.series)
    for (auto* errors : {&series.handError, &series.objectError})
      for (double& e : *errors) e = std::sqrt(e / static_cast<double>(series.trials));
}

void check(const StudyOptions& options) {
  const auto refuse = [](bool bad, const char* text) {
    if (bad) throw UsageError(text);
  };
  refuse(!(options.measure.onset.percent > 0 && options.measure.onset.percent < 100),
         "onset percent: allowed: more than 0 and less than 100");
  refuse(!(options.measure.onset.speed > 0), "onset speed: allowed: more than 0 m/s");
  refuse(!(options.measure.cutoff >= 0), "cut-off: allowed: 0 (none) or more Hz");
  refuse(options.ranking.resamples < 100, "resamples: allowed: 100 or more");
  refuse(options.learningBin < 1, "learning bin: allowed: 1 trial or more");
  refuse(options.handMass && !(*options.handMass >= 0), "hand mass: allowed: 0 kg or more");
}

}  // namespace

StudyResult analyzeStudy(StudyInput input, const StudyOptions& options, const StudyProgress& progress) {
  check(options);
  StudyResult study;
  study.options = options;
  study.conditions = std::move(input.conditions);
  for (std::size_t i = 0; i < input.trials.size(); ++i) {
    study.trials.push_back(measureTrial(input.trials[i], input.conditionOf.at(i), options));
    countTrial(input.trials[i], study.trials.back(), study.conditions.size(), study.results);
    input.trials[i] = {};
    if (progress) progress(i + 1, input.trials.size());
  }
  study.results.resize(study.conditions.size());
  useFailuresWhereNothingSucceeded(study);
  std::stable_sort(study.trials.begin(), study.trials.end(),
                   [](const StudyTrial& a, const StudyTrial& b) { return orderOf(a) < orderOf(b); });
  for (std::size_t c = 0; c < study.conditions.size(); ++c) summarise(study.trials, c, study.conditions[c], options, study.results[c]);
  for (StudyTrial& trial : study.trials) addErrors(trial, study.results[trial.condition]);
  for (std::size_t c = 0; c < study.conditions.size(); ++c) rankCondition(study.trials, c, options, study.results[c]);
  rankTogether(study);
  addSeries(study);
  study.success = successTable(study.trials);
  study.learning = learningCurves(study.trials, options.learningBin);
  std::set<std::string> subjects;
  for (const StudyTrial& trial : study.trials) subjects.insert(trial.key.subject);
  study.subjects.assign(subjects.begin(), subjects.end());
  return study;
}

}  // namespace reachlab::analyze
