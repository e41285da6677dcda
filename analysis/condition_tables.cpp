#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "analysis/sheet.h"
#include "sim/experiment/experiment.h"

namespace reachlab::analysis {
namespace {

void meanProfilesTable(const Analysis& analysis, Sheet& table) {
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    const ConditionResult& r = analysis.results[c];
    for (std::size_t i = 0; i < r.hand.mean.size(); ++i)
      table.row(analysis.conditions[c].name, i, r.duration.mean * static_cast<double>(i) / 100, r.used, r.hand.mean[i], r.hand.sd[i],
                r.object.mean[i], r.object.sd[i]);
  }
}

void predictionsTable(const Analysis& analysis, Sheet& table) {
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    const ConditionResult& r = analysis.results[c];
    const auto add = [&](const PredictedSignal& signal) {
      const PredictedCurve curve = curveOf(signal);
      for (std::size_t i = 0; i < curve.time.size(); ++i)
        table.row(analysis.conditions[c].name, predict::nameOf(signal.criterion), signal.plannedDuration,
                  100.0 * static_cast<double>(i) / static_cast<double>(curve.time.size() - 1), curve.time[i], curve.hand[i],
                  curve.object[i]);
    };
    for (const PredictedSignal& signal : r.signals) add(signal);
    if (r.moved) add(*r.moved);
  }
}

void rankingTable(const Analysis& analysis, Sheet& table) {
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    const ConditionResult& r = analysis.results[c];
    std::set<std::string> people;
    for (const AnalyzedTrial& t : analysis.trials)
      if (t.condition == c && t.used()) people.insert(t.key.subject);
    for (const bool object : {false, true}) {
      int place = 0;
      for (const EpsilonPlace& p : object ? r.objectEpsilon : r.handEpsilon) {
        ++place;
        table.row(analysis.conditions[c].name, object ? "object" : "hand", place, predict::nameOf(r.signals[p.criterion].criterion),
                  p.epsilon, p.mean, p.interval, p.difference, p.differenceInterval,
                  place == 1 || !p.differenceInterval ? ""
                  : p.apart                           ? "yes"
                                                      : "no",
                  r.used, people.size());
      }
    }
  }
}

void seriesTable(const Analysis& analysis, Sheet& table) {
  for (const SeriesResult& s : analysis.series) {
    const auto& signals = analysis.results[s.condition].signals;
    for (const auto& [signal, errors] : {std::pair{"hand", &s.handError}, std::pair{"object", &s.objectError}})
      for (std::size_t k = 0; k < errors->size(); ++k)
        table.row(s.key.subject, s.key.session, s.key.run, s.key.block, s.key.day, analysis.conditions[s.condition].name, signal,
                  predict::nameOf(signals[k].criterion), (*errors)[k], s.trials);
  }
}

void fitsTable(const Analysis& analysis, Sheet& table) {
  for (const FitRow& f : fitRows(analysis)) {
    const bool toward = !f.toward.empty();
    const PersonResult& person = *f.person;
    const CandidateFit& fit = *f.fit;
    table.row(f.condition, person.subject, f.criterion, fmt::format("{}", fmt::join(f.equivalent, ";")), fit.epsilonOfAll, fit.r2,
              fit.meanScore, person.fit.own.ceiling, fit.duration, f.timeLaw, f.plan, f.handMass,
              fit.mass ? std::optional(fit.mass->interval) : std::nullopt, fit.mass ? std::optional(fit.mass->atEdge) : std::nullopt,
              f.misfit, fit.systematic.share, fit.systematic.p(), f.toward, toward ? f.towardShare : kNotMeasured,
              toward ? f.towardP : kNotMeasured, person.trials, f.decided, nameOf(person.conclusion.reason));
  }
}

void addConclusion(Sheet& table, const std::string& condition, const Conclusion& c,
                   const std::vector<std::vector<predict::Criterion>>& candidates, const std::optional<std::string>& choice = {}) {
  for (std::size_t k = 0; k < c.score.size(); ++k) {
    if (choice) table.cells(*choice);
    const bool best = k == *c.best, mixed = best && c.mixedWith;
    const auto ofOthers = [&](const auto& value) { return best ? std::nullopt : std::optional(value); };
    const auto ofBest = [&](const auto& value) { return best ? std::optional(value) : std::nullopt; };
    const auto ofMixed = [&](const auto& value) { return mixed ? std::optional(value) : std::nullopt; };
    const Bounds share = computeBinomialInterval(c.closest[k], c.subjects).percent();
    table.row(condition, c.overSubjects ? "subjects" : "trials", nameOfCandidate(candidates[k]), c.score[k], best ? 0.0 : c.against[k].mean,
              ofOthers(intervalOf(c.against[k])), ofOthers(c.against[k].p), ofOthers(computeBayesFactor(c.against[k])), c.closest[k],
              100 * static_cast<double>(c.closest[k]) / static_cast<double>(c.subjects), share,
              std::count(c.each.begin(), c.each.end(), std::optional(k)), c.posterior.empty() ? kNotMeasured : c.posterior[k],
              best ? "yes" : "no", c.follows == k, c.decided() ? "" : nameOf(c.reason), c.level,
              std::find(c.atEdge.begin(), c.atEdge.end(), k) != c.atEdge.end(), ofBest(c.misfit.mean), ofBest(c.misfit.p),
              ofBest(c.systematic.share), ofBest(c.systematic.p()), mixed ? nameOfCandidate(candidates[*c.mixedWith]) : "",
              ofMixed(c.mixture.mean), ofMixed(intervalOf(c.mixture)), ofMixed(c.mixtureP), c.subjects, c.trials);
  }
}

void conclusionsTable(const Analysis& analysis, Sheet& table) {
  for (std::size_t c = 0; c < analysis.results.size(); ++c)
    addConclusion(table, analysis.conditions[c].name, analysis.results[c].conclusion, namesOf(analysis.results[c].candidates));
  addConclusion(table, kAllTogether, analysis.overall, analysis.common);
}

void alternativeScoresTable(const Analysis& analysis, Sheet& table) {
  for (const AlternativeConclusion& row : analysis.alternatives)
    addConclusion(table, row.condition, row.conclusion, row.candidates, row.choice);
}

void conditionsTable(const Analysis& analysis, Sheet& table) {
  const AnalysisOptions& o = analysis.options;
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    const ConditionResult& r = analysis.results[c];
    const experiment::Experiment& e = analysis.conditions[c].experiment();
    const ConditionCounts& n = r.counts;
    const char* outcome = r.used == 0 ? "" : r.onlyFailures ? "failure" : "success";
    const auto ofUsed = [&](double value) { return r.used > 0 ? value : kNotMeasured; };
    table.row(analysis.conditions[c].name, e.name, e.task ? e.task->duration : kNotMeasured, n.success, n.failure, n.aborted, n.interrupted,
              n.invalidTiming, n.practice, n.catchTrials, n.beforeGo, n.otherWay, r.used, outcome, r.duration.mean, r.duration.sd,
              r.movementTime.mean, r.movementTime.sd, ofUsed(r.movementRange.low), ofUsed(r.movementRange.high),
              nameOf(o.measure.onset.rule), o.measure.onset.percent, o.measure.onset.speed, o.measure.cutoff,
              o.handMass.value_or(e.handMass), fmt::format("{:.17g}", fmt::join(r.candidates.masses, ";")), o.handDamping,
              o.predictFor == PredictionDuration::Moved ? "mean" : "task", o.includePractice, o.learningBin);
  }
}

/// Successes, trials, their share and its interval [%].
void addShare(Sheet& table, std::size_t successes, std::size_t trials, const Bounds& interval) {
  table.row(successes, trials, 100.0 * static_cast<double>(successes) / static_cast<double>(trials), interval.percent());
}

void successRows(const Analysis& analysis, Sheet& table) {
  for (const SuccessCell& cell : analysis.success) {
    table.cells(cell.subject, cell.day, analysis.conditions[cell.condition].name);
    addShare(table, cell.successes, cell.trials, cell.interval);
  }
}

void learningTable(const Analysis& analysis, Sheet& table) {
  for (const LearningPoint& p : analysis.learning) {
    table.cells(p.subject, p.session, analysis.conditions[p.condition].name, p.firstTrial, p.lastTrial);
    addShare(table, p.successes, p.trials, p.interval);
  }
}

void effectsTable(const Analysis& analysis, Sheet& table) {
  for (const Effect& e : analysis.effects) {
    const auto place = [&](int i) { return e.ofDay ? "D" + std::to_string(i) : analysis.conditions[static_cast<std::size_t>(i)].name; };
    const Bounds logits = e.logitInterval;
    table.row(e.ofDay ? "day" : "condition", e.ofDay ? analysis.conditions[e.condition].name : "", place(e.from), place(e.to), e.people,
              e.points.mean, e.pointsInterval, std::exp(e.logit.mean),
              logits.finite() ? Bounds{std::exp(logits.low), std::exp(logits.high)} : logits, e.people > 1 ? e.p : kNotMeasured);
  }
  for (const LearningSlope& s : analysis.slopes)
    table.row("slope", analysis.conditions[s.condition].name, "", "", s.people, s.perHundred, s.interval, kNotMeasured,
              std::optional<Bounds>(), s.people > 1 ? s.p : kNotMeasured);
}

}  // namespace

void writeConditionTables(const Analysis& analysis, const TableWriter& write) {
  writeSheet(write, "mean_profiles.csv", analysis, meanProfilesTable);
  writeSheet(write, "predictions.csv", analysis, predictionsTable);
  writeSheet(write, "ranking.csv", analysis, rankingTable);
  writeSheet(write, "series.csv", analysis, seriesTable);
  writeSheet(write, "fits.csv", analysis, fitsTable);
  writeSheet(write, "conclusions.csv", analysis, conclusionsTable);
  if (!analysis.alternatives.empty()) writeSheet(write, "alternative_scores.csv", analysis, alternativeScoresTable);
  writeSheet(write, "conditions.csv", analysis, conditionsTable);
  writeSheet(write, "success_table.csv", analysis, successRows);
  writeSheet(write, "learning.csv", analysis, learningTable);
  writeSheet(write, "effects.csv", analysis, effectsTable);
}

}  // namespace reachlab::analysis
