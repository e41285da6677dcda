#include <algorithm>
#include <map>
#include <tuple>

#include "analysis/sheet.h"
#include "analysis/steps.h"

namespace reachlab::analysis {
namespace {

using predict::Criterion;
using predict::kCriterionCount;

/// Criteria that were predicted in any condition, in the paper's order: the columns of the trial table.
std::vector<Criterion> allCriteria(const Analysis& analysis) {
  std::vector<Criterion> out;
  for (int i = 0; i < kCriterionCount; ++i)
    for (const ConditionResult& result : analysis.results)
      if (std::any_of(result.signals.begin(), result.signals.end(),
                      [&](const PredictedSignal& p) { return p.criterion == static_cast<Criterion>(i); })) {
        out.push_back(static_cast<Criterion>(i));
        break;
      }
  return out;
}

double errorFor(const AnalyzedTrial& trial, const ConditionResult& result, Criterion criterion, bool object) {
  const std::size_t criteria = trial.paperError.size() / 2;
  for (std::size_t k = 0; k < criteria; ++k)
    if (result.signals[k].criterion == criterion) return trial.paperError[k + (object ? criteria : 0)];
  return kNotMeasured;
}

void trialsTable(const Analysis& analysis, const TableWriter& write) {
  const std::vector<Criterion> criteria = allCriteria(analysis);
  std::vector<std::string> columns;
  for (const char* what : {"hand", "object"})
    for (const Criterion c : criteria) columns.push_back(std::string("epsilon_") + what + "_" + columnOf(c) + "_m_per_s");
  Sheet table(write, "trials.csv", columns);
  for (const AnalyzedTrial& t : analysis.trials) {
    table.cell(t.key.subject).cell(t.key.session).whole(t.key.run).whole(t.key.block).whole(t.key.trial).whole(t.key.day);
    table.cell(analysis.conditions[t.condition].name).cell(t.key.kind).cell(t.key.target).cell(t.practice ? "practice" : "recorded");
    table.cell(trial::nameOf(t.result.outcome));
    table.cell(t.result.reason == trial::Reason::None ? "" : trial::nameOf(t.result.reason)).whole(t.result.mass).number(t.result.by);
    table.whole(t.used()).cell(t.exclusion).whole(t.measures.beforeGo).whole(t.otherWay);
    for (const Measure& measure : measures()) table.number(t.measures.*measure.value);
    for (const bool object : {false, true})
      for (const Criterion c : criteria) table.number(errorFor(t, analysis.results[t.condition], c, object));
    table.endRow();
  }
  table.flush();
}

void profilesTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "profiles.csv");
  for (const AnalyzedTrial& t : analysis.trials) {
    if (!t.used()) continue;
    const TrialProfile profile = analysis.profileOf(t);
    const double mean = analysis.results[t.condition].duration.mean, factor = profile.duration / mean;
    for (std::size_t i = 0; i < kProfilePoints; ++i) {
      table.cell(analysis.conditions[t.condition].name).cell(t.key.subject).cell(t.key.session).whole(t.key.run).whole(t.key.trial);
      table.whole(static_cast<long long>(i)).number(mean * static_cast<double>(i) / 100);
      table.number(factor * profile.hand[i]).number(factor * profile.object[i]);
      table.endRow();
    }
  }
  table.flush();
}

void exclusionsTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "exclusions.csv");
  std::map<std::tuple<std::size_t, std::string, std::string>, std::size_t> counts;
  for (const AnalyzedTrial& t : analysis.trials) ++counts[{t.condition, t.key.subject, t.used() ? "used" : t.exclusion}];
  for (const auto& [which, count] : counts) {
    const auto& [condition, subject, rule] = which;
    table.cell(analysis.conditions[condition].name).cell(subject).cell(rule).count(count);
    table.endRow();
  }
  table.flush();
}

void fitTrialsTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "fit_trials.csv");
  for (const PersonResult& person : analysis.people) {
    if (!person.fitted) continue;
    const auto& candidates = analysis.results[person.condition].candidates.candidates;
    std::size_t place = 0;
    for (const AnalyzedTrial* trial : fittedTrials(analysis, person)) {
      const AnalyzedTrial& t = *trial;
      for (std::size_t k = 0; k < candidates.size(); ++k) {
        const CandidateFit& fit = person.fit.candidates[k];
        const MovementFit& at = fit.trials[place];
        table.cell(analysis.conditions[t.condition].name).cell(t.key.subject).cell(t.key.session).whole(t.key.run).whole(t.key.trial);
        table.count(place % kFolds).cell(nameOfCandidate(candidates[k].criteria));
        table.number(at.found ? at.onset : kNotMeasured).number(at.found ? at.duration : kNotMeasured);
        table.number(at.found ? at.amplitude : kNotMeasured).number(fit.epsilon[place]);
        table.number(at.found ? 1 - at.cost / person.rest[place] : kNotMeasured).number(fit.score[place]);
        table.number(person.fit.own.score[place]);
        table.endRow();
      }
      ++place;
    }
  }
  table.flush();
}

/// Names of the candidates that any condition has, the reference last.
std::vector<std::string> allCandidates(const Analysis& analysis) {
  std::vector<std::string> out;
  for (const ConditionResult& result : analysis.results)
    for (const Candidate& candidate : result.candidates.candidates)
      if (const std::string name = nameOfCandidate(candidate.criteria);
          !candidate.reference() && std::find(out.begin(), out.end(), name) == out.end())
        out.push_back(name);
  out.push_back(nameOfCandidate({}));
  return out;
}

/// What one candidate leaves of a person's trial, at every sample of its window.
std::vector<double> residualsOf(const FitWindow& window, const CandidateFit& fit, std::size_t place) {
  const MovementFit& at = fit.trials[place];
  Profile profile;
  if (!at.found || !fit.family->at(fit.choice.law == TimeLaw::OnePlan ? fit.choice.plan : at.duration, profile)) return window.velocity;
  return residualsOf(window, profile, at);
}

void residualsTable(const Analysis& analysis, const TableWriter& write) {
  const std::vector<std::string> names = allCandidates(analysis);
  std::vector<std::string> columns;
  for (std::string name : names) {
    std::replace(name.begin(), name.end(), '-', '_');
    columns.push_back("residual_" + name + "_m_per_s");
  }
  Sheet table(write, "residuals.csv", columns);
  for (const PersonResult& person : analysis.people) {
    if (!person.fitted) continue;
    const auto& candidates = analysis.results[person.condition].candidates.candidates;
    std::size_t place = 0;
    for (const AnalyzedTrial* t : fittedTrials(analysis, person)) {
      FitWindow window = windowOf(analysis, *t);
      weigh(window, person.fit.own, place);
      std::map<std::string, std::vector<double>> residuals;
      for (std::size_t k = 0; k < candidates.size(); ++k)
        residuals[nameOfCandidate(candidates[k].criteria)] = residualsOf(window, person.fit.candidates[k], place);
      const MovementFit& own = person.fit.own.place[place];
      for (std::size_t i = 0; i < window.velocity.size(); ++i) {
        const double time = window.begin + static_cast<double>(i) / window.rate;
        table.cell(analysis.conditions[t->condition].name).cell(t->key.subject).cell(t->key.session).whole(t->key.run).whole(t->key.trial);
        table.number(time).number((time - own.onset) / own.duration).number(window.weight[i]).number(window.velocity[i]);
        for (const std::string& name : names) table.number(residuals.contains(name) ? residuals[name][i] : kNotMeasured);
        table.endRow();
      }
      ++place;
    }
  }
  table.flush();
}

}  // namespace

void writeTrialTables(const Analysis& analysis, const TableWriter& write) {
  trialsTable(analysis, write);
  profilesTable(analysis, write);
  exclusionsTable(analysis, write);
  fitTrialsTable(analysis, write);
  if (analysis.options.residuals) residualsTable(analysis, write);
}

}  // namespace reachlab::analysis
