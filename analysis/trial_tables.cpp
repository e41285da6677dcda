#include <algorithm>
#include <map>
#include <tuple>

#include "analysis/sheet.h"
#include "analysis/steps.h"

namespace reachlab::analysis {
namespace {

using predict::Criterion;

/// Criteria that were predicted in any condition, in the paper's order: the columns of the trial table.
std::vector<Criterion> allCriteria(const Analysis& analysis) {
  std::vector<Criterion> out;
  for (const Criterion criterion : predict::kAllCriteria) {
    if (std::any_of(analysis.results.begin(), analysis.results.end(), [&](const ConditionResult& r) { return r.predicts(criterion); }))
      out.push_back(criterion);
  }
  return out;
}

double errorFor(const AnalyzedTrial& trial, const ConditionResult& result, Criterion criterion, bool object) {
  const std::size_t criteria = trial.paperError.size() / 2;
  for (std::size_t k = 0; k < criteria; ++k)
    if (result.signals[k].criterion == criterion) return trial.paperError[k + (object ? criteria : 0)];
  return kNotMeasured;
}

std::vector<std::string> epsilonColumns(const Analysis& analysis) {
  std::vector<std::string> columns;
  for (const char* what : {"hand", "object"})
    for (const Criterion c : allCriteria(analysis))
      columns.push_back(std::string("epsilon_") + what + "_" + underscored(nameOf(c)) + "_m_per_s");
  return columns;
}

/// The cells that tell a trial.
Sheet& trialCells(const Analysis& analysis, const AnalyzedTrial& t, Sheet& table) {
  return table.cells(analysis.conditions[t.condition].name, t.key.subject, t.key.session, t.key.run, t.key.trial);
}

/// `visit(person, trial, place)` for every trial of every fitted person.
template <class Visit>
void eachFittedTrial(const Analysis& analysis, Visit&& visit) {
  for (const PersonResult& person : analysis.people) {
    if (!person.fitted) continue;
    std::size_t place = 0;
    for (const AnalyzedTrial* trial : fittedTrials(analysis, person)) visit(person, *trial, place++);
  }
}

void trialsTable(const Analysis& analysis, Sheet& table) {
  const std::vector<Criterion> criteria = allCriteria(analysis);
  for (const AnalyzedTrial& t : analysis.trials) {
    table.cells(t.key.subject, t.key.session, t.key.run, t.key.block, t.key.trial, t.key.day, analysis.conditions[t.condition].name,
                t.key.kind, t.key.target, t.practice ? "practice" : "recorded", trial::nameOf(t.result.outcome),
                t.result.reason == trial::Reason::None ? "" : trial::nameOf(t.result.reason), t.result.mass, t.result.by, t.used(),
                t.exclusion, t.measures.beforeGo, t.otherWay);
    for (const Measure& measure : measures()) table.cells(t.measures.*measure.value);
    for (const bool object : {false, true})
      for (const Criterion c : criteria) table.cells(errorFor(t, analysis.results[t.condition], c, object));
    table.endRow();
  }
}

void profilesTable(const Analysis& analysis, Sheet& table) {
  for (const AnalyzedTrial& t : analysis.trials) {
    if (!t.used()) continue;
    const TrialProfile profile = analysis.profileOf(t);
    const double mean = analysis.results[t.condition].duration.mean, factor = profile.duration / mean;
    for (std::size_t i = 0; i < kProfilePoints; ++i)
      trialCells(analysis, t, table).row(i, mean * static_cast<double>(i) / 100, factor * profile.hand[i], factor * profile.object[i]);
  }
}

void exclusionsTable(const Analysis& analysis, Sheet& table) {
  std::map<std::tuple<std::size_t, std::string, std::string>, std::size_t> counts;
  for (const AnalyzedTrial& t : analysis.trials) ++counts[{t.condition, t.key.subject, t.used() ? "used" : t.exclusion}];
  for (const auto& [which, count] : counts) {
    const auto& [condition, subject, rule] = which;
    table.row(analysis.conditions[condition].name, subject, rule, count);
  }
}

void fitTrialsTable(const Analysis& analysis, Sheet& table) {
  eachFittedTrial(analysis, [&](const PersonResult& person, const AnalyzedTrial& t, std::size_t place) {
    const auto& candidates = analysis.results[person.condition].candidates.candidates;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const CandidateFit& fit = person.fit.candidates[k];
      const MovementFit& at = fit.trials[place];
      const auto found = [&](double value) { return at.found ? value : kNotMeasured; };
      trialCells(analysis, t, table)
          .row(place % kFolds, nameOfCandidate(candidates[k].criteria), found(at.onset), found(at.duration), found(at.amplitude),
               fit.epsilon[place], found(1 - at.cost / person.rest[place]), fit.score[place], person.fit.own.score[place]);
    }
  });
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

std::vector<std::string> residualColumns(const Analysis& analysis) {
  std::vector<std::string> columns;
  for (const std::string& name : allCandidates(analysis)) columns.push_back("residual_" + underscored(name) + "_m_per_s");
  return columns;
}

void residualsTable(const Analysis& analysis, Sheet& table) {
  const std::vector<std::string> names = allCandidates(analysis);
  eachFittedTrial(analysis, [&](const PersonResult& person, const AnalyzedTrial& t, std::size_t place) {
    const auto& candidates = analysis.results[person.condition].candidates.candidates;
    FitWindow window = windowOf(analysis, t);
    weigh(window, person.fit.own, place);
    std::map<std::string, std::vector<double>> residuals;
    for (std::size_t k = 0; k < candidates.size(); ++k)
      residuals[nameOfCandidate(candidates[k].criteria)] = residualsOf(window, person.fit.candidates[k], place);
    const MovementFit& own = person.fit.own.place[place];
    for (std::size_t i = 0; i < window.velocity.size(); ++i) {
      const double time = window.begin + static_cast<double>(i) / window.rate;
      trialCells(analysis, t, table).cells(time, (time - own.onset) / own.duration, window.weight[i], window.velocity[i]);
      for (const std::string& name : names) table.cells(residuals.contains(name) ? residuals[name][i] : kNotMeasured);
      table.endRow();
    }
  });
}

}  // namespace

void writeTrialTables(const Analysis& analysis, const TableWriter& write) {
  writeSheet(write, "trials.csv", analysis, trialsTable, epsilonColumns(analysis));
  writeSheet(write, "profiles.csv", analysis, profilesTable);
  writeSheet(write, "exclusions.csv", analysis, exclusionsTable);
  writeSheet(write, "fit_trials.csv", analysis, fitTrialsTable);
  if (analysis.options.residuals) writeSheet(write, "residuals.csv", analysis, residualsTable, residualColumns(analysis));
}

}  // namespace reachlab::analysis
