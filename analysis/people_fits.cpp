#include <algorithm>
#include <set>

#include "analysis/steps.h"

namespace reachlab::analysis {

FitWindow windowOf(const Analysis& analysis, const AnalyzedTrial& trial) {
  FitWindow window;
  window.rate = trial.windowRate;
  window.begin = trial.windowBegin;
  window.velocity = analysis.signals->get(trial.window);
  window.weight.assign(window.velocity.size(), 1.0);
  return window;
}

std::vector<const AnalyzedTrial*> fittedTrials(const Analysis& analysis, const PersonResult& person) {
  std::vector<const AnalyzedTrial*> out;
  for (std::size_t i = person.firstTrial; out.size() < person.trials; ++i)
    if (const AnalyzedTrial& trial = analysis.trials[i]; trial.used() && trial.window.size > 0) out.push_back(&trial);
  return out;
}

void fitPeople(Analysis& analysis, std::size_t condition, const FittingProgress& progress) {
  ConditionResult& result = analysis.results[condition];
  const std::span<AnalyzedTrial> trials = trialsOf(analysis, condition);
  const auto offset = static_cast<std::size_t>(trials.data() - analysis.trials.data());
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
      windows.push_back(windowOf(analysis, trials[i]));
      durations.push_back(trials[i].measures.duration);
    }
    person.trials = windows.size();
    person.duration = durations.empty() ? kNotMeasured : computeMeanSd(durations).mean;
    if (windows.size() >= kFewestTrials) {
      if (result.candidates.candidates.empty()) {
        CandidateOptions how;
        how.criteria = predict::orAll(analysis.options.criteria);
        std::erase_if(how.criteria, [&](predict::Criterion c) { return !holdsFor(analysis.conditions[condition], c); });
        how.handMasses = analysis.options.handMasses;
        how.handMass = analysis.options.handMass;
        how.handDamping = analysis.options.handDamping;
        how.cutoff = analysis.options.measure.cutoff;
        how.rate = windows.front().rate;
        result.candidates = makeCandidates(analysis.conditions[condition].compiled, how);
      }
      person.fit = fitPerson(windows, durations, result.candidates, analysis.options.keepScatter);
      person.fitted = true;
      for (const FitWindow& w : windows) person.rest.push_back(restCost(w));
      const std::size_t candidates = result.candidates.candidates.size();
      person.conclusion =
          concludePerson(scoresOf(person, result.candidates), candidates, candidates - 1, heavyLimits(namesOf(result.candidates)));
    }
    analysis.people.push_back(std::move(person));
    if (progress) progress(offset + end, analysis.trials.size());
    first = end;
  }
  result.conclusion = concludeCondition(analysis.people, condition, result.candidates);
}

void concludeTogether(Analysis& analysis) {
  // A subject who lacks a condition would differ from the others for that alone. Averaged are therefore the conditions of the most subjects, and
  // only those that have the same subjects.
  std::vector<std::set<std::string>> fitted(analysis.results.size());
  for (const PersonResult& person : analysis.people)
    if (person.fitted) fitted[person.condition].insert(person.subject);
  std::set<std::string> most;
  for (const std::set<std::string>& subjects : fitted)
    if (subjects.size() > most.size()) most = subjects;
  std::vector<std::size_t>& judged = analysis.together;
  for (std::size_t c = 0; c < fitted.size(); ++c)
    if (!most.empty() && fitted[c] == most) judged.push_back(c);
  if (judged.empty()) {
    analysis.overall.subjects = 0;
    return;
  }
  for (const Candidate& candidate : analysis.results[judged.front()].candidates.candidates) {
    const bool everywhere = std::all_of(judged.begin(), judged.end(), [&](std::size_t c) {
      const auto& others = analysis.results[c].candidates.candidates;
      return std::any_of(others.begin(), others.end(), [&](const Candidate& o) { return o.criteria == candidate.criteria; });
    });
    if (everywhere) analysis.common.push_back(candidate.criteria);
  }
  std::vector<PersonScores> people;
  for (const std::string& subject : analysis.subjects) {
    PersonScores person;
    person.subject = subject;
    bool tried = false;  // who did only other conditions is not left out for lack of trials
    for (const PersonResult& own : analysis.people) {
      if (own.subject != subject || std::find(judged.begin(), judged.end(), own.condition) == judged.end()) continue;
      tried = true;
      if (own.fitted) person.conditions.push_back(scoresOf(own, analysis.results[own.condition].candidates, analysis.common));
    }
    if (tried) people.push_back(std::move(person));
  }
  analysis.overall = concludePeople(people, analysis.common.size(), analysis.common.size() - 1, heavyLimits(analysis.common));
}

ConditionScores scoresOf(const PersonResult& person, const CandidateSet& set, const std::vector<std::vector<predict::Criterion>>& common) {
  ConditionScores out;
  out.condition = person.condition;
  out.effectiveSamples = person.fit.own.effectiveSamples;
  out.ceiling = person.fit.own.ceiling;
  out.own = person.fit.own.score;
  std::vector<std::size_t> places;
  for (const auto& criteria : common)
    for (std::size_t k = 0; k < set.candidates.size(); ++k)
      if (set.candidates[k].criteria == criteria) places.push_back(k);
  for (const std::size_t k : places) {
    const CandidateFit& fit = person.fit.candidates[k];
    out.score.push_back(fit.score), out.r2.push_back(fit.r2), out.beyond.push_back(fit.beyond), out.systematic.push_back(fit.systematic);
    auto& toward = out.toward.emplace_back();
    for (std::size_t i = 0; i < places.size() && !fit.toward.empty(); ++i) toward.push_back(fit.toward[places[i]]);
  }
  return out;
}

PersonScores scoresOf(const PersonResult& person, const CandidateSet& set) {
  PersonScores out{person.subject, {}};
  if (person.fitted) out.conditions.push_back(scoresOf(person, set, namesOf(set)));
  return out;
}

std::vector<HeavyLimit> heavyLimits(const std::vector<std::vector<predict::Criterion>>& candidates) {
  const auto candidate = placeOf(candidates, predict::Criterion::MinHandForceChange);
  const auto becomes = placeOf(candidates, predict::Criterion::MinHandJerk);
  if (!candidate || !becomes) return {};
  return {HeavyLimit{*candidate, *becomes}};
}

Conclusion concludeCondition(const std::vector<PersonResult>& people, std::size_t condition, const CandidateSet& set) {
  std::vector<PersonScores> scores;
  for (const PersonResult& person : people)
    if (person.condition == condition) scores.push_back(scoresOf(person, set));
  return concludePeople(scores, set.candidates.size(), set.candidates.size() - 1, heavyLimits(namesOf(set)));
}

}  // namespace reachlab::analysis
