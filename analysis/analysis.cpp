#include "analysis/analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include "analysis/conclusions/fit_window.h"
#include "analysis/steps.h"
#include "base/error.h"
#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/run_names.h"

namespace reachlab::analysis {
namespace {

bool isBefore(const AnalyzedTrial& a, const AnalyzedTrial& b) {
  if (std::tie(a.condition, a.key.subject) != std::tie(b.condition, b.key.subject))
    return std::tie(a.condition, a.key.subject) < std::tie(b.condition, b.key.subject);
  return recordedBefore(a.key, b.key);
}

std::string whyExcluded(const AnalyzedTrial& trial, const TrialData& data, const Movement& movement, const AnalysisOptions& options) {
  if (!data.excluded.empty()) return "excluded: " + data.excluded;
  if (trial.catchTrial) return "catch trial";
  if (trial.practice && !options.includePractice) return "practice";
  const bool failed = trial.result.outcome == trial::Outcome::Failure;
  if (trial.result.outcome != trial::Outcome::Success && !(failed && options.includeFailures))
    return trial.result.outcome == trial::Outcome::Interrupted && trial.result.reason == trial::Reason::Timing
               ? "invalid timing"
               : std::string(nameOf(trial.result.outcome));
  if (!data.notSeen.empty()) return data.notSeen;
  const bool marked = std::isfinite(data.markedOnset) || std::isfinite(data.markedOffset);
  if (!movement.found) return marked ? "no movement between onset and end (marks count from the arming of the trial)" : "no movement found";
  return {};
}

/// Where nothing succeeded, the failed movements are still worth looking at; they are shown as such and nothing is concluded from them.
void useFailuresWhereNothingSucceeded(Analysis& analysis) {
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    const auto ofCondition = [&](const AnalyzedTrial& t) { return t.condition == c; };
    if (std::any_of(analysis.trials.begin(), analysis.trials.end(), [&](const AnalyzedTrial& t) { return ofCondition(t) && t.used(); }))
      continue;
    for (AnalyzedTrial& trial : analysis.trials) {
      if (!ofCondition(trial) || !trial.counted || trial.exclusion != nameOf(trial.result.outcome) || trial.profile.size == 0) continue;
      --analysis.results[c].exclusions[trial.exclusion];
      trial.exclusion.clear();
      analysis.results[c].onlyFailures = true;
    }
    std::erase_if(analysis.results[c].exclusions, [](const auto& entry) { return entry.second == 0; });
  }
}

/// Slow, moderate, fast: the longest task first, else as they were first recorded.
void orderConditions(Analysis& analysis) {
  std::vector<std::size_t> order(analysis.conditions.size()), place(order.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto durationOf = [&](std::size_t c) {
    const auto& task = analysis.conditions[c].experiment().task;
    return task ? task->duration : 0.0;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return durationOf(a) > durationOf(b); });
  std::vector<Condition> conditions;
  std::vector<ConditionResult> results;
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    conditions.push_back(std::move(analysis.conditions[order[i]]));
    results.push_back(std::move(analysis.results[order[i]]));
  }
  analysis.conditions = std::move(conditions);
  analysis.results = std::move(results);
  for (AnalyzedTrial& trial : analysis.trials) trial.condition = place[trial.condition];
}

/// Where the plan gave no day, the subject's sessions are days 1, 2, … in their order. A session with another run of a day is of that day.
void numberDays(std::vector<AnalyzedTrial>& trials) {
  std::map<std::string, std::set<std::string, decltype(&record::labelBefore)>> sessions;
  std::map<std::pair<std::string, std::string>, int> given;
  for (const AnalyzedTrial& trial : trials) {
    sessions.try_emplace(trial.key.subject, record::labelBefore).first->second.insert(trial.key.session);
    if (trial.key.day > 0) given.emplace(std::pair{trial.key.subject, trial.key.session}, trial.key.day);
  }
  for (AnalyzedTrial& trial : trials) {
    if (trial.key.day > 0) continue;
    const auto& own = sessions.at(trial.key.subject);
    const auto known = given.find({trial.key.subject, trial.key.session});
    trial.key.day = known != given.end() ? known->second : 1 + static_cast<int>(std::distance(own.begin(), own.find(trial.key.session)));
  }
}

void addSeries(Analysis& analysis) {
  const auto sameSeries = [](const AnalyzedTrial& a, const SeriesResult& b) {
    return a.condition == b.condition && a.key.subject == b.key.subject && a.key.session == b.key.session && a.key.run == b.key.run;
  };
  for (const AnalyzedTrial& trial : analysis.trials) {
    if (!trial.used()) continue;
    const std::size_t criteria = trial.paperError.size() / 2;
    if (analysis.series.empty() || !sameSeries(trial, analysis.series.back())) {
      SeriesResult series{trial.key, trial.condition, 0, std::vector<double>(criteria, 0.0), {}};
      series.key.trial = 0;
      series.objectError = series.handError;
      analysis.series.push_back(series);
    }
    SeriesResult& series = analysis.series.back();
    ++series.trials;
    for (std::size_t c = 0; c < criteria; ++c) {
      series.handError[c] += trial.paperError[c] * trial.paperError[c];
      series.objectError[c] += trial.paperError[criteria + c] * trial.paperError[criteria + c];
    }
  }
  // Every trial has the same number of samples, so the mean of their mean squares is the mean over all samples.
  for (SeriesResult& series : analysis.series)
    for (auto* errors : {&series.handError, &series.objectError})
      for (double& e : *errors) e = std::sqrt(e / static_cast<double>(series.trials));
}

void addProgress(Analysis& analysis) {
  std::vector<Attempt> attempts;
  for (const AnalyzedTrial& t : analysis.trials)
    if (t.counted) attempts.push_back({t.key.subject, t.key.session, t.key.day, t.condition, t.result.outcome == trial::Outcome::Success});
  analysis.success = successTable(attempts);
  analysis.learning = learningCurves(attempts, analysis.options.learningBin);
  analysis.effects = effectsOf(analysis.success, analysis.conditions.size());
  analysis.slopes = learningSlopes(attempts, analysis.conditions.size());
  for (std::size_t c = 0; c < analysis.results.size(); ++c) analysis.results[c].success = typicalShare(analysis.success, c);
}

void check(const AnalysisOptions& options) {
  const auto refuse = [](bool bad, const char* key, double value, const char* allowed) {
    if (bad) throw FaultError(Fault{key, fmt::format("is {}", value), allowed});
  };
  const auto& onset = options.measure.onset;
  refuse(!(onset.percent > 0 && onset.percent < 100), "onset_percent", onset.percent, "more than 0 and less than 100");
  refuse(!(onset.speed > 0), "onset_speed", onset.speed, "more than 0 m/s");
  refuse(!(options.measure.cutoff >= 0), "cutoff", options.measure.cutoff, "0 (none) or more Hz");
  refuse(options.learningBin < 1, "learning_bin", options.learningBin, "1 trial or more");
  if (options.handMass) refuse(!(*options.handMass >= 0), "hand_mass", *options.handMass, "0 kg or more");
  if (options.handMasses.empty()) throw FaultError(Fault{"hand_masses", "is empty", "one or more"});
  for (const double mass : options.handMasses) refuse(!(mass >= 0) || !std::isfinite(mass), "hand_masses", mass, "0 kg or more each");
}

}  // namespace

void countTrial(const AnalyzedTrial& trial, ConditionResult& result) {
  if (!trial.exclusion.empty()) ++result.exclusions[trial.exclusion];
  if (trial.catchTrial) {
    ++result.counts.catchTrials;
    return;
  }
  if (trial.practice) ++result.counts.practice;
  if (trial.isLeftOut()) return;
  switch (trial.result.outcome) {
    case trial::Outcome::Success: ++result.counts.success; break;
    case trial::Outcome::Failure: ++result.counts.failure; break;
    case trial::Outcome::Aborted: ++result.counts.aborted; break;
    case trial::Outcome::Interrupted: ++result.counts.interrupted; break;
    case trial::Outcome::None: break;
  }
  if (trial.result.outcome != trial::Outcome::Success && trial.result.reason != trial::Reason::None)
    ++result.reasons[std::string(nameOf(trial.result.reason))];
  if (trial.result.outcome == trial::Outcome::Interrupted && trial.result.reason == trial::Reason::Timing) ++result.counts.invalidTiming;
  if (trial.measures.beforeGo) ++result.counts.beforeGo;
  if (trial.otherWay) ++result.counts.otherWay;
}

TrialProfile Analysis::profileOf(const AnalyzedTrial& trial) const {
  TrialProfile out;
  if (trial.profile.size == 0) return out;
  const std::vector<double> both = signals->get(trial.profile);
  const auto middle = both.begin() + static_cast<std::ptrdiff_t>(kProfilePoints);
  out.hand.assign(both.begin(), middle);
  out.object.assign(middle, both.end());
  out.duration = trial.measures.duration;
  out.endLevel = trial.endLevel;
  return out;
}

AnalysisBuilder::AnalysisBuilder(const AnalysisOptions& options) : signals_(std::make_shared<SignalStore>()) {
  check(options);
  analysis_.options = options;
}

void AnalysisBuilder::add(TrialData&& data, std::size_t condition) {
  const AnalysisOptions& options = analysis_.options;
  AnalyzedTrial trial;
  static_cast<TrialFacts&>(trial) = data;
  trial.condition = condition;
  const TrialSignals signals = computeSignals(data, options.measure);
  trial.otherWay = signals.otherWay;
  trial.measures = computeMeasures(data, signals);
  trial.exclusion = whyExcluded(trial, data, signals.movement, options);
  trial.counted = data.excluded.empty() && !trial.catchTrial && (!trial.practice || options.includePractice) &&
                  (trial.result.outcome == trial::Outcome::Success || trial.result.outcome == trial::Outcome::Failure);
  if (signals.movement.found) {
    TrialProfile profile = makeTrialProfile(data, signals);
    trial.endLevel = profile.endLevel;
    profile.hand.insert(profile.hand.end(), profile.object.begin(), profile.object.end());
    trial.profile = signals_->put(profile.hand);
  }
  if (trial.used())
    if (const auto window = makeFitWindow(data, signals)) {
      trial.window = signals_->put(window->velocity);
      trial.windowBegin = window->begin;
      trial.windowRate = window->rate;
    }
  analysis_.trials.push_back(std::move(trial));
}

Analysis AnalysisBuilder::finish(std::vector<Condition> conditions, const FittingProgress& fitting) {
  Analysis analysis = std::move(analysis_);
  analysis.signals = signals_;
  analysis.conditions = std::move(conditions);
  analysis.results.resize(analysis.conditions.size());
  for (const AnalyzedTrial& trial : analysis.trials) countTrial(trial, analysis.results[trial.condition]);
  orderConditions(analysis);
  numberDays(analysis.trials);
  useFailuresWhereNothingSucceeded(analysis);
  std::stable_sort(analysis.trials.begin(), analysis.trials.end(), isBefore);
  std::set<std::string> subjects;
  for (const AnalyzedTrial& trial : analysis.trials) subjects.insert(trial.key.subject);
  analysis.subjects.assign(subjects.begin(), subjects.end());
  for (std::size_t c = 0; c < analysis.conditions.size(); ++c) summarise(analysis, c);
  for (std::size_t c = 0; c < analysis.conditions.size(); ++c) fitPeople(analysis, c, fitting);
  concludeTogether(analysis);
  addSeries(analysis);
  addProgress(analysis);
  return analysis;
}

Analysis analyzeTrials(AnalysisInput input, const AnalysisOptions& options, const FittingProgress& progress) {
  AnalysisBuilder builder(options);
  for (std::size_t i = 0; i < input.trials.size(); ++i) builder.add(std::move(input.trials[i]), input.conditionOf.at(i));
  return builder.finish(std::move(input.conditions), progress);
}

}  // namespace reachlab::analysis
