#include "analysis/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include "analysis/conclusions/fit_window.h"
#include "analysis/counts.h"
#include "analysis/epsilon_table.h"
#include "base/error.h"
#include "base/fault.h"
#include "sim/experiment/experiment.h"

namespace reachlab::analysis {
namespace {

auto orderOf(const StudyTrial& t) { return std::tie(t.condition, t.key.subject, t.key.session, t.key.run, t.key.trial); }

std::string whyExcluded(const StudyTrial& trial, const std::string& excluded, const Movement& movement, bool includePractice) {
  if (!excluded.empty()) return "excluded: " + excluded;
  if (trial.catchTrial) return "catch trial";
  if (trial.practice && !includePractice) return "practice";
  if (trial.result.outcome != trial::Outcome::Success)
    return trial.result.outcome == trial::Outcome::Interrupted && nameOf(trial.result.reason) == "timing"
               ? "invalid timing"
               : std::string(nameOf(trial.result.outcome));
  if (!movement.found) return "no movement found";
  return {};
}

/// Where nothing succeeded, the failed movements are still worth looking at; they are shown as such and nothing is concluded from them.
void useFailuresWhereNothingSucceeded(StudyResult& study) {
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const auto ofCondition = [&](const StudyTrial& t) { return t.condition == c; };
    if (std::any_of(study.trials.begin(), study.trials.end(), [&](const StudyTrial& t) { return ofCondition(t) && t.used(); })) continue;
    for (StudyTrial& trial : study.trials) {
      if (!ofCondition(trial) || !trial.counted || trial.profile.size == 0) continue;
      --study.results[c].exclusions[trial.exclusion];
      trial.exclusion.clear();
      study.results[c].onlyFailures = true;
    }
    std::erase_if(study.results[c].exclusions, [](const auto& entry) { return entry.second == 0; });
  }
}

/// Slow, moderate, fast: the longest task first, else as they were first recorded.
void orderConditions(StudyResult& study) {
  std::vector<std::size_t> order(study.conditions.size()), place(order.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto durationOf = [&](std::size_t c) {
    const auto& task = study.conditions[c].experiment().task;
    return task ? task->duration : 0.0;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return durationOf(a) > durationOf(b); });
  std::vector<StudyCondition> conditions;
  std::vector<ConditionResult> results;
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    conditions.push_back(std::move(study.conditions[order[i]]));
    results.push_back(std::move(study.results[order[i]]));
  }
  study.conditions = std::move(conditions);
  study.results = std::move(results);
  for (StudyTrial& trial : study.trials) trial.condition = place[trial.condition];
}

/// Where the plan gave no day, the subject's sessions are days 1, 2, … in their order.
void numberDays(std::vector<StudyTrial>& trials) {
  std::map<std::string, std::set<std::string>> sessions;
  for (const StudyTrial& trial : trials) sessions[trial.key.subject].insert(trial.key.session);
  for (StudyTrial& trial : trials) {
    if (trial.key.day > 0) continue;
    const auto& own = sessions[trial.key.subject];
    trial.key.day = 1 + static_cast<int>(std::distance(own.begin(), own.find(trial.key.session)));
  }
}

std::vector<predict::Criterion> wantedCriteria(const StudyOptions& options) {
  if (!options.criteria.empty()) return options.criteria;
  std::vector<predict::Criterion> all;
  for (int i = 0; i < predict::kCriterionCount; ++i) all.push_back(static_cast<predict::Criterion>(i));
  return all;
}

/// The prediction whose movement, measured like a trial's, lasts `measured`: fixed-point steps on its duration.
std::unique_ptr<predict::Prediction> predictLasting(const StudyCondition& condition, predict::Criterion criterion,
                                                    predict::PredictOptions how, const StudyOptions& options,
                                                    const ConditionResult& result) {
  how.duration = condition.experiment().task->duration;
  std::unique_ptr<predict::Prediction> prediction;
  for (int step = 0; step < 8; ++step) {
    prediction = predict::predict(condition.compiled, criterion, how);
    const PredictedSignal signal = recordPrediction(*prediction, options.measure, *condition.experiment().task);
    const double ratio = result.duration.mean / durationUntil(signal, result.endLevel);
    if (std::abs(ratio - 1) < 1e-6) break;
    how.duration *= ratio;
  }
  return prediction;
}

void addPredictions(const StudyCondition& condition, const StudyOptions& options, ConditionResult& result) {
  if (!condition.experiment().task) {
    result.refusals.push_back("the experiment has no task to predict");
    return;
  }
  predict::PredictOptions how;
  how.handMass = options.handMass;
  how.handDamping = options.handDamping;
  for (const predict::Criterion criterion : wantedCriteria(options)) {
    try {
      std::unique_ptr<predict::Prediction> prediction = options.predictFor == PredictionDuration::Moved && result.used > 0
                                                            ? predictLasting(condition, criterion, how, options, result)
                                                            : predict::predict(condition.compiled, criterion, how);
      result.signals.push_back(recordPrediction(*prediction, options.measure, *condition.experiment().task));
      result.predictions.push_back(std::move(prediction));
    } catch (const Error& error) {
      const std::string what = error.what();
      result.refusals.push_back(what.starts_with(nameOf(criterion)) ? what : fmt::format("{}: {}", nameOf(criterion), what));
    }
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

std::span<StudyTrial> trialsOf(StudyResult& study, std::size_t condition) {
  const auto first = std::find_if(study.trials.begin(), study.trials.end(), [&](const StudyTrial& t) { return t.condition >= condition; });
  const auto last = std::find_if(first, study.trials.end(), [&](const StudyTrial& t) { return t.condition > condition; });
  return {first, last};
}

void summarise(StudyResult& study, std::size_t condition) {
  ConditionResult& result = study.results[condition];
  const std::span<StudyTrial> trials = trialsOf(study, condition);
  std::vector<double> durations, times, levels;
  for (const StudyTrial& trial : trials) {
    if (!trial.used()) continue;
    durations.push_back(trial.measures.duration);
    times.push_back(trial.measures.movementTime);
    levels.push_back(trial.endLevel);
  }
  result.used = durations.size();
  result.endLevel = levels.empty() ? study.options.measure.onset.percent / 100 : computeMeanSd(levels).mean;
  result.duration = computeMeanSd(durations);
  result.movementTime = computeMeanSd(times);
  if (!times.empty()) result.movementRange = {*std::min_element(times.begin(), times.end()), *std::max_element(times.begin(), times.end())};
  addPredictions(study.conditions[condition], study.options, result);
  RunningProfile hand, object;
  for (StudyTrial& trial : trials) {
    if (!trial.used()) continue;
    const TrialProfile profile = study.profileOf(trial);
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

FitWindow windowOf(const StudyResult& study, const StudyTrial& trial) {
  FitWindow window;
  window.rate = trial.windowRate;
  window.begin = trial.windowBegin;
  window.velocity = study.signals->get(trial.window);
  window.weight.assign(window.velocity.size(), 1.0);
  return window;
}

void fitPeople(StudyResult& study, std::size_t condition, const StudyProgress& progress) {
  ConditionResult& result = study.results[condition];
  const std::span<StudyTrial> trials = trialsOf(study, condition);
  const auto offset = static_cast<std::size_t>(trials.data() - study.trials.data());
  for (std::size_t first = 0; first < trials.size();) {
    std::size_t end = first;
    while (end < trials.size() && trials[end].key.subject == trials[first].key.subject) ++end;
    PersonResult person;
    person.subject = trials[first].key.subject;
    person.condition = condition;
    person.firstTrial = offset + first;
    std::vector<FitWindow> windows;
    std::vector<double> durations;
    for (std::size_t i = first; i < end; ++i) {
      if (!trials[i].used() || trials[i].window.size == 0 || result.onlyFailures) continue;
      windows.push_back(windowOf(study, trials[i]));
      durations.push_back(trials[i].measures.duration);
    }
    person.trials = windows.size();
    person.duration = durations.empty() ? kNotMeasured : computeMeanSd(durations).mean;
    if (windows.size() >= kFewestTrials) {
      if (result.candidates.candidates.empty()) {
        CandidateOptions how;
        how.criteria = study.options.criteria;
        how.handMasses = study.options.handMasses;
        how.handMass = study.options.handMass;
        how.handDamping = study.options.handDamping;
        how.cutoff = study.options.measure.cutoff;
        how.rate = windows.front().rate;
        result.candidates = makeCandidates(study.conditions[condition].compiled, how);
      }
      person.fit = fitPerson(windows, durations, result.candidates, study.options.keepScatter);
      person.fitted = true;
      for (const FitWindow& w : windows) person.rest.push_back(restCost(w));
      PersonScores scores = scoresOf(person);
      const std::size_t candidates = result.candidates.candidates.size();
      person.follows = concludePerson(scores, candidates, candidates - 1).follows;
    }
    study.people.push_back(std::move(person));
    if (progress) progress(offset + end, study.trials.size());
    first = end;
  }
  result.conclusion = concludeCondition(study.people, condition, result.candidates);
}

/// Over all conditions: the candidates that every condition with fits has.
void concludeTogether(StudyResult& study) {
  // A subject who lacks a condition would differ from the others for that alone, so only conditions that all have are averaged.
  std::set<std::string> anywhere;
  std::vector<std::size_t> fitted(study.results.size(), 0);
  for (const PersonResult& person : study.people)
    if (person.fitted) anywhere.insert(person.subject), ++fitted[person.condition];
  std::vector<std::size_t>& judged = study.together;
  for (std::size_t c = 0; c < study.results.size(); ++c)
    if (fitted[c] > 0 && fitted[c] == anywhere.size()) judged.push_back(c);
  for (std::size_t c = 0; judged.empty() && c < study.results.size(); ++c)  // none: the one that most have
    if (fitted[c] > 0 && fitted[c] == *std::max_element(fitted.begin(), fitted.end())) judged = {c};
  if (judged.empty()) {
    study.overall.subjects = 0;
    return;
  }
  for (const Candidate& candidate : study.results[judged.front()].candidates.candidates) {
    const bool everywhere = std::all_of(judged.begin(), judged.end(), [&](std::size_t c) {
      const auto& others = study.results[c].candidates.candidates;
      return std::any_of(others.begin(), others.end(), [&](const Candidate& o) { return o.criteria == candidate.criteria; });
    });
    if (everywhere) study.common.push_back(candidate.criteria);
  }
  std::vector<PersonScores> people;
  for (const std::string& subject : study.subjects) {
    PersonScores person;
    person.subject = subject;
    for (const PersonResult& own : study.people) {
      if (own.subject != subject || !own.fitted || std::find(judged.begin(), judged.end(), own.condition) == judged.end()) continue;
      const auto& candidates = study.results[own.condition].candidates.candidates;
      const PersonScores here = scoresOf(own);
      ConditionScores scores = here.conditions.front();
      scores.score.clear();
      scores.r2.clear();
      for (const auto& criteria : study.common)
        for (std::size_t k = 0; k < candidates.size(); ++k)
          if (candidates[k].criteria == criteria) {
            scores.score.push_back(here.conditions.front().score[k]);
            scores.r2.push_back(here.conditions.front().r2[k]);
          }
      person.conditions.push_back(std::move(scores));
    }
    people.push_back(std::move(person));
  }
  study.overall = concludePeople(people, study.common.size(), study.common.size() - 1);
}

void addSeries(StudyResult& study) {
  const auto sameSeries = [](const StudyTrial& a, const SeriesResult& b) {
    return a.condition == b.condition && a.key.subject == b.key.subject && a.key.session == b.key.session && a.key.run == b.key.run;
  };
  for (const StudyTrial& trial : study.trials) {
    if (!trial.used()) continue;
    const std::size_t criteria = trial.paperError.size() / 2;
    if (study.series.empty() || !sameSeries(trial, study.series.back())) {
      SeriesResult series{trial.key, trial.condition, 0, std::vector<double>(criteria, 0.0), {}};
      series.key.trial = 0;
      series.objectError = series.handError;
      study.series.push_back(series);
    }
    SeriesResult& series = study.series.back();
    ++series.trials;
    for (std::size_t c = 0; c < criteria; ++c) {
      series.handError[c] += trial.paperError[c] * trial.paperError[c];
      series.objectError[c] += trial.paperError[criteria + c] * trial.paperError[criteria + c];
    }
  }
  // Every trial has the same number of samples, so the mean of their mean squares is the mean over all samples.
  for (SeriesResult& series : study.series)
    for (auto* errors : {&series.handError, &series.objectError})
      for (double& e : *errors) e = std::sqrt(e / static_cast<double>(series.trials));
}

void addProgress(StudyResult& study) {
  std::vector<Attempt> attempts;
  for (const StudyTrial& t : study.trials)
    if (t.counted) attempts.push_back({t.key.subject, t.key.session, t.key.day, t.condition, t.result.outcome == trial::Outcome::Success});
  study.success = successTable(attempts);
  study.learning = learningCurves(attempts, study.options.learningBin);
  study.effects = effectsOf(study.success, study.conditions.size());
  study.slopes = learningSlopes(attempts, study.conditions.size());
  for (std::size_t c = 0; c < study.results.size(); ++c) study.results[c].success = typicalShare(study.success, c);
}

void check(const StudyOptions& options) {
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

TrialProfile StudyResult::profileOf(const StudyTrial& trial) const {
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

PersonScores scoresOf(const PersonResult& person) {
  PersonScores out;
  out.subject = person.subject;
  if (!person.fitted) return out;
  ConditionScores scores;
  scores.condition = person.condition;
  scores.effectiveSamples = person.fit.own.effectiveSamples;
  scores.ceiling = person.fit.own.ceiling;
  for (const CandidateFit& fit : person.fit.candidates) scores.score.push_back(fit.score), scores.r2.push_back(fit.r2);
  out.conditions.push_back(std::move(scores));
  return out;
}

Conclusion concludeCondition(const std::vector<PersonResult>& people, std::size_t condition, const CandidateSet& set) {
  std::vector<PersonScores> scores;
  for (const PersonResult& person : people)
    if (person.condition == condition) scores.push_back(scoresOf(person));
  const std::size_t candidates = set.candidates.size();
  return concludePeople(scores, candidates, candidates - 1);
}

StudyBuilder::StudyBuilder(const StudyOptions& options) : signals_(std::make_shared<SignalStore>()) {
  check(options);
  study_.options = options;
}

void StudyBuilder::add(TrialData&& data, std::size_t condition) {
  const StudyOptions& options = study_.options;
  StudyTrial trial;
  trial.key = std::move(data.key);
  trial.condition = condition;
  trial.result = data.result;
  trial.practice = data.practice;
  trial.catchTrial = data.catchTrial;
  const TrialSignals signals = computeSignals(data, options.measure);
  trial.otherWay = signals.otherWay;
  trial.measures = computeMeasures(data, signals);
  trial.exclusion = whyExcluded(trial, data.excluded, signals.movement, options.includePractice);
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
  study_.trials.push_back(std::move(trial));
}

void StudyBuilder::takeBack(std::size_t count) { study_.trials.resize(study_.trials.size() - std::min(count, study_.trials.size())); }

StudyResult StudyBuilder::finish(std::vector<StudyCondition> conditions, const StudyProgress& fitting) {
  StudyResult study = std::move(study_);
  study.signals = signals_;
  study.conditions = std::move(conditions);
  study.results.resize(study.conditions.size());
  for (const StudyTrial& trial : study.trials) countTrial(trial, study.results[trial.condition]);
  orderConditions(study);
  numberDays(study.trials);
  useFailuresWhereNothingSucceeded(study);
  std::stable_sort(study.trials.begin(), study.trials.end(),
                   [](const StudyTrial& a, const StudyTrial& b) { return orderOf(a) < orderOf(b); });
  std::set<std::string> subjects;
  for (const StudyTrial& trial : study.trials) subjects.insert(trial.key.subject);
  study.subjects.assign(subjects.begin(), subjects.end());
  for (std::size_t c = 0; c < study.conditions.size(); ++c) summarise(study, c);
  for (std::size_t c = 0; c < study.conditions.size(); ++c) fitPeople(study, c, fitting);
  concludeTogether(study);
  addSeries(study);
  addProgress(study);
  return study;
}

StudyResult analyzeStudy(StudyInput input, const StudyOptions& options, const StudyProgress& progress) {
  StudyBuilder builder(options);
  for (std::size_t i = 0; i < input.trials.size(); ++i) builder.add(std::move(input.trials[i]), input.conditionOf.at(i));
  return builder.finish(std::move(input.conditions), progress);
}

}  // namespace reachlab::analysis
