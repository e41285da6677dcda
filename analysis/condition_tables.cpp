#include <algorithm>
#include <utility>

#include "analysis/sheet.h"
#include "sim/experiment/experiment.h"

namespace reachlab::analysis {
namespace {

void meanProfilesTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "mean_profiles.csv");
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    const ConditionResult& r = analysis.results[c];
    for (std::size_t i = 0; i < r.hand.mean.size(); ++i) {
      table.cell(analysis.conditions[c].name).whole(static_cast<long long>(i)).number(r.duration.mean * static_cast<double>(i) / 100);
      table.count(r.used).number(r.hand.mean[i]).number(r.hand.sd[i]).number(r.object.mean[i]).number(r.object.sd[i]);
      table.endRow();
    }
  }
  table.flush();
}

void predictionsTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "predictions.csv");
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    const ConditionResult& r = analysis.results[c];
    const auto add = [&](const predict::Prediction& prediction, const PredictedSignal& signal) {
      const PredictedCurve curve = curveOf(prediction, signal);
      for (std::size_t i = 0; i < curve.time.size(); ++i) {
        table.cell(analysis.conditions[c].name).cell(predict::nameOf(signal.criterion)).number(signal.plannedDuration);
        table.number(100.0 * static_cast<double>(i) / static_cast<double>(curve.time.size() - 1)).number(curve.time[i]);
        table.number(curve.hand[i]).number(curve.object[i]);
        table.endRow();
      }
    };
    for (std::size_t k = 0; k < r.signals.size(); ++k) add(*r.predictions[k], r.signals[k]);
    if (r.moved) add(*r.moved, r.movedSignal);
  }
  table.flush();
}

void rankingTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "ranking.csv");
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    const ConditionResult& r = analysis.results[c];
    std::size_t people = 0;
    for (const PersonResult& p : analysis.people) people += p.condition == c && p.trials > 0 ? 1 : 0;
    for (const bool object : {false, true}) {
      int place = 0;
      for (const EpsilonPlace& p : object ? r.objectEpsilon : r.handEpsilon) {
        table.cell(analysis.conditions[c].name).cell(object ? "object" : "hand").whole(++place);
        table.cell(predict::nameOf(r.signals[p.criterion].criterion)).number(p.epsilon);
        table.bounds(p.interval).number(p.difference);
        table.bounds(p.differenceInterval).cell(place == 1 || !p.differenceInterval ? "" : p.apart ? "yes" : "no");
        table.count(r.used);
        table.count(people);
        table.endRow();
      }
    }
  }
  table.flush();
}

void seriesTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "series.csv");
  for (const SeriesResult& s : analysis.series) {
    const auto& signals = analysis.results[s.condition].signals;
    for (const auto& [signal, errors] : {std::pair{"hand", &s.handError}, std::pair{"object", &s.objectError}})
      for (std::size_t k = 0; k < errors->size(); ++k) {
        table.cell(s.key.subject).cell(s.key.session).whole(s.key.run).whole(s.key.block).whole(s.key.day);
        table.cell(analysis.conditions[s.condition].name).cell(signal).cell(predict::nameOf(signals[k].criterion)).number((*errors)[k]);
        table.count(s.trials);
        table.endRow();
      }
  }
  table.flush();
}

void fitsTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "fits.csv");
  for (const FitRow& f : fitRows(analysis)) {
    table.cell(f.condition).cell(f.subject).cell(f.criterion);
    std::string others;
    for (const std::string& name : f.equivalent) others += (others.empty() ? "" : ";") + name;
    table.cell(others).number(f.epsilon).number(f.r2).number(f.score).number(f.ceiling).number(f.duration).cell(f.timeLaw);
    table.number(f.plan.value_or(kNotMeasured)).number(f.handMass.value_or(kNotMeasured)).bounds(f.massInterval);
    table.cell(f.massInterval ? f.massAtEdge ? "1" : "0" : "").number(f.misfit);
    table.number(f.systematic.share).number(f.systematic.p()).cell(f.toward);
    table.number(f.toward.empty() ? kNotMeasured : f.towardShare).number(f.toward.empty() ? kNotMeasured : f.towardP);
    table.count(f.trials).whole(f.decided).cell(f.reason);
    table.endRow();
  }
  table.flush();
}

void addConclusion(Sheet& table, const std::string& condition, const Conclusion& c,
                   const std::vector<std::vector<predict::Criterion>>& candidates, const std::optional<std::string>& choice = {}) {
  for (std::size_t k = 0; k < c.score.size(); ++k) {
    if (choice) table.cell(*choice);
    table.cell(condition).cell(c.overSubjects ? "subjects" : "trials").cell(nameOfCandidate(candidates[k])).number(c.score[k]);
    const bool best = k == *c.best;
    table.number(best ? 0 : c.against[k].mean);
    table.bounds(best ? std::nullopt : std::optional(intervalOf(c.against[k]))).number(best ? kNotMeasured : c.against[k].p);
    table.number(best ? kNotMeasured : computeBayesFactor(c.against[k]));
    const Bounds share = computeBinomialInterval(c.closest[k], c.subjects);
    table.count(c.closest[k]).number(100 * static_cast<double>(c.closest[k]) / static_cast<double>(c.subjects));
    table.number(100 * share.low).number(100 * share.high);
    table.count(static_cast<std::size_t>(std::count(c.each.begin(), c.each.end(), std::optional(k))));
    table.number(c.posterior.empty() ? kNotMeasured : c.posterior[k]).cell(best ? "yes" : "no").whole(c.follows && *c.follows == k);
    table.cell(c.decided() ? "" : nameOf(c.reason)).number(c.level);
    table.whole(std::find(c.atEdge.begin(), c.atEdge.end(), k) != c.atEdge.end());
    table.number(best ? c.misfit.mean : kNotMeasured).number(best ? c.misfit.p : kNotMeasured);
    table.number(best ? c.systematic.share : kNotMeasured).number(best ? c.systematic.p() : kNotMeasured);
    const bool mixed = best && c.mixedWith;
    table.cell(mixed ? nameOfCandidate(candidates[*c.mixedWith]) : "").number(mixed ? c.mixture.mean : kNotMeasured);
    table.bounds(mixed ? std::optional(intervalOf(c.mixture)) : std::nullopt).number(mixed ? c.mixtureP : kNotMeasured);
    table.count(c.subjects);
    table.count(c.trials);
    table.endRow();
  }
}

void conclusionsTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "conclusions.csv");
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    std::vector<std::vector<predict::Criterion>> names;
    for (const Candidate& candidate : analysis.results[c].candidates.candidates) names.push_back(candidate.criteria);
    addConclusion(table, analysis.conditions[c].name, analysis.results[c].conclusion, names);
  }
  addConclusion(table, kAllTogether, analysis.overall, analysis.common);
  table.flush();
}

void alternativeScoresTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "alternative_scores.csv");
  for (const AlternativeConclusion& row : analysis.alternatives)
    addConclusion(table, row.condition, row.conclusion, row.candidates, row.choice);
  table.flush();
}

void conditionsTable(const Analysis& analysis, const TableWriter& write) {
  const AnalysisOptions& o = analysis.options;
  Sheet table(write, "conditions.csv");
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    const ConditionResult& r = analysis.results[c];
    const experiment::Experiment& e = analysis.conditions[c].experiment();
    table.cell(analysis.conditions[c].name).cell(e.name).number(e.task ? e.task->duration : kNotMeasured);
    for (const std::size_t n : {r.counts.success, r.counts.failure, r.counts.aborted, r.counts.interrupted, r.counts.invalidTiming,
                                r.counts.practice, r.counts.catchTrials, r.counts.beforeGo, r.counts.otherWay, r.used})
      table.count(n);
    table.cell(r.used == 0 ? "" : r.onlyFailures ? "failure" : "success").number(r.duration.mean).number(r.duration.sd);
    table.number(r.movementTime.mean).number(r.movementTime.sd);
    table.number(r.used > 0 ? r.movementRange.low : kNotMeasured).number(r.used > 0 ? r.movementRange.high : kNotMeasured);
    table.cell(nameOf(o.measure.onset.rule)).number(o.measure.onset.percent).number(o.measure.onset.speed).number(o.measure.cutoff);
    table.number(o.handMass.value_or(e.handMass));
    std::string masses;
    for (const double m : r.candidates.masses) {
      TableText one(',', "");
      masses += (masses.empty() ? "" : ";") + one.number(m).text();
    }
    table.cell(masses).number(o.handDamping);
    table.endRow();
  }
  table.flush();
}

}  // namespace

void writeConditionTables(const Analysis& analysis, const TableWriter& write) {
  meanProfilesTable(analysis, write);
  predictionsTable(analysis, write);
  rankingTable(analysis, write);
  seriesTable(analysis, write);
  fitsTable(analysis, write);
  conclusionsTable(analysis, write);
  if (!analysis.alternatives.empty()) alternativeScoresTable(analysis, write);
  conditionsTable(analysis, write);
}

}  // namespace reachlab::analysis
