#include "analysis/tables.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/table_text.h"
#include "sim/experiment/experiment.h"

namespace reachlab::analysis {
namespace {

using predict::Criterion;
using predict::kCriterionCount;

TableText& count(TableText& table, std::size_t n) { return table.whole(static_cast<long long>(n)); }
TableText& finite(TableText& table, const std::optional<Interval>& interval) {
  return table.number(interval ? interval->low : kNotMeasured).number(interval ? interval->high : kNotMeasured);
}

/// A table that goes to its file piece by piece.
struct Sheet {
  const TableWriter& write;
  std::string name;
  TableText table{',', ""};
  Sheet(const TableWriter& writer, const char* file, const std::vector<std::string>& columns) : write(writer), name(file) {
    table.row(columns);
  }
  ~Sheet() = default;
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;
  void endRow() {
    constexpr std::size_t kPiece = std::size_t{1} << 20;
    table.endRow();
    if (table.text().size() > kPiece) flush();
  }
  void flush() { write(name, table.takeText()); }
};

/// Criteria that were predicted in any condition, in the paper's order: the columns of the trial table.
std::vector<Criterion> allCriteria(const StudyResult& study) {
  std::vector<Criterion> out;
  for (int i = 0; i < kCriterionCount; ++i)
    for (const ConditionResult& result : study.results)
      if (std::any_of(result.signals.begin(), result.signals.end(),
                      [&](const PredictedSignal& p) { return p.criterion == static_cast<Criterion>(i); })) {
        out.push_back(static_cast<Criterion>(i));
        break;
      }
  return out;
}

double errorFor(const StudyTrial& trial, const ConditionResult& result, Criterion criterion, bool object) {
  const std::size_t criteria = trial.paperError.size() / 2;
  for (std::size_t k = 0; k < criteria; ++k)
    if (result.signals[k].criterion == criterion) return trial.paperError[k + (object ? criteria : 0)];
  return kNotMeasured;
}

void trialsTable(const StudyResult& study, const TableWriter& write) {
  std::vector<std::string> columns{"subject",
                                   "session",
                                   "run",
                                   "block",
                                   "trial",
                                   "day",
                                   "condition",
                                   "phase",
                                   "outcome",
                                   "reason",
                                   "mass",
                                   "by",
                                   "used",
                                   "exclusion",
                                   "before_go",
                                   "other_way",
                                   "reaction_time_s",
                                   "onset_s",
                                   "offset_s",
                                   "duration_s",
                                   "movement_time_s",
                                   "peak_speed_m_per_s",
                                   "time_to_peak_s",
                                   "time_to_peak_percent",
                                   "symmetry_ratio",
                                   "path_length_m",
                                   "speed_peaks",
                                   "hand_endpoint_error_m",
                                   "object_endpoint_error_m",
                                   "hand_overshoot_m",
                                   "object_overshoot_m",
                                   "sparc",
                                   "ldlj",
                                   "peak_force_n",
                                   "mean_force_n"};
  const std::vector<Criterion> criteria = allCriteria(study);
  for (const char* what : {"hand", "object"})
    for (const Criterion c : criteria) columns.push_back(std::string("epsilon_") + what + "_" + columnOf(c) + "_m_per_s");
  Sheet sheet(write, "trials.csv", columns);
  TableText& table = sheet.table;
  for (const StudyTrial& t : study.trials) {
    table.cell(t.key.subject).cell(t.key.session).whole(t.key.run).whole(t.key.block).whole(t.key.trial).whole(t.key.day);
    table.cell(study.conditions[t.condition].name).cell(t.practice ? "practice" : "recorded").cell(trial::nameOf(t.result.outcome));
    table.cell(t.result.reason == trial::Reason::None ? "" : trial::nameOf(t.result.reason)).whole(t.result.mass).number(t.result.by);
    table.whole(t.used()).cell(t.exclusion).whole(t.measures.beforeGo).whole(t.otherWay);
    const TrialMeasures& m = t.measures;
    for (const double v : {m.reactionTime, m.onset, m.offset, m.duration, m.movementTime, m.peakSpeed, m.timeToPeak, m.timeToPeakPercent,
                           m.symmetryRatio, m.pathLength, m.speedPeaks, m.handEndpointError, m.objectEndpointError, m.handOvershoot,
                           m.objectOvershoot, m.sparc, m.ldlj, m.peakForce, m.meanForce})
      table.number(v);
    for (const bool object : {false, true})
      for (const Criterion c : criteria) table.number(errorFor(t, study.results[t.condition], c, object));
    sheet.endRow();
  }
  sheet.flush();
}

void profilesTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "profiles.csv",
              {"condition", "subject", "session", "run", "trial", "percent", "time_s", "hand_m_per_s", "object_m_per_s"});
  TableText& table = sheet.table;
  for (const StudyTrial& t : study.trials) {
    if (!t.used()) continue;
    const TrialProfile profile = study.profileOf(t);
    const double mean = study.results[t.condition].duration.mean, factor = profile.duration / mean;
    for (std::size_t i = 0; i < kProfilePoints; ++i) {
      table.cell(study.conditions[t.condition].name).cell(t.key.subject).cell(t.key.session).whole(t.key.run).whole(t.key.trial);
      table.whole(static_cast<long long>(i)).number(mean * static_cast<double>(i) / 100);
      table.number(factor * profile.hand[i]).number(factor * profile.object[i]);
      sheet.endRow();
    }
  }
  sheet.flush();
}

void meanProfilesTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(
      write, "mean_profiles.csv",
      {"condition", "percent", "time_s", "trials", "hand_mean_m_per_s", "hand_sd_m_per_s", "object_mean_m_per_s", "object_sd_m_per_s"});
  TableText& table = sheet.table;
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const ConditionResult& r = study.results[c];
    for (std::size_t i = 0; i < r.hand.mean.size(); ++i) {
      table.cell(study.conditions[c].name).whole(static_cast<long long>(i)).number(r.duration.mean * static_cast<double>(i) / 100);
      count(table, r.used).number(r.hand.mean[i]).number(r.hand.sd[i]).number(r.object.mean[i]).number(r.object.sd[i]);
      sheet.endRow();
    }
  }
  sheet.flush();
}

void predictionsTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "predictions.csv",
              {"condition", "criterion", "predicted_duration_s", "percent", "time_s", "hand_m_per_s", "object_m_per_s"});
  TableText& table = sheet.table;
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const ConditionResult& r = study.results[c];
    for (std::size_t k = 0; k < r.signals.size(); ++k) {
      const PredictedCurve curve = curveOf(r, k);
      for (std::size_t i = 0; i < curve.time.size(); ++i) {
        table.cell(study.conditions[c].name).cell(predict::nameOf(r.signals[k].criterion)).number(r.signals[k].plannedDuration);
        table.number(100.0 * static_cast<double>(i) / static_cast<double>(curve.time.size() - 1)).number(curve.time[i]);
        table.number(curve.hand[i]).number(curve.object[i]);
        sheet.endRow();
      }
    }
  }
  sheet.flush();
}

void rankingTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "ranking.csv",
              {"condition", "signal", "rank", "criterion", "epsilon_m_per_s", "epsilon_low_m_per_s", "epsilon_high_m_per_s",
               "difference_m_per_s", "difference_low_m_per_s", "difference_high_m_per_s", "apart_from_first", "trials", "subjects"});
  TableText& table = sheet.table;
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const ConditionResult& r = study.results[c];
    std::size_t people = 0;
    for (const PersonResult& p : study.people) people += p.condition == c && p.trials > 0 ? 1 : 0;
    for (const bool object : {false, true}) {
      int place = 0;
      for (const EpsilonPlace& p : object ? r.objectEpsilon : r.handEpsilon) {
        table.cell(study.conditions[c].name).cell(object ? "object" : "hand").whole(++place);
        table.cell(predict::nameOf(r.signals[p.criterion].criterion)).number(p.epsilon);
        finite(table, p.interval).number(p.difference);
        finite(table, p.differenceInterval).cell(place == 1 || !p.differenceInterval ? "" : p.apart ? "yes" : "no");
        count(table, r.used);
        count(table, people);
        sheet.endRow();
      }
    }
  }
  sheet.flush();
}

void seriesTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "series.csv",
              {"subject", "session", "run", "block", "day", "condition", "signal", "criterion", "epsilon_m_per_s", "trials"});
  TableText& table = sheet.table;
  for (const SeriesResult& s : study.series) {
    const auto& signals = study.results[s.condition].signals;
    for (const auto& [signal, errors] : {std::pair{"hand", &s.handError}, std::pair{"object", &s.objectError}})
      for (std::size_t k = 0; k < errors->size(); ++k) {
        table.cell(s.key.subject).cell(s.key.session).whole(s.key.run).whole(s.key.block).whole(s.key.day);
        table.cell(study.conditions[s.condition].name).cell(signal).cell(predict::nameOf(signals[k].criterion)).number((*errors)[k]);
        count(table, s.trials);
        sheet.endRow();
      }
  }
  sheet.flush();
}

void fitsTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "fits.csv",
              {"condition", "subject", "criterion", "equivalent", "epsilon_fit_m_per_s", "r2", "score", "ceiling", "duration_s", "time_law",
               "plan_s", "hand_mass_kg", "trials", "decided"});
  TableText& table = sheet.table;
  for (const FitRow& f : fitRows(study)) {
    table.cell(f.condition).cell(f.subject).cell(f.criterion);
    std::string others;
    for (const std::string& name : f.equivalent) others += (others.empty() ? "" : ";") + name;
    table.cell(others).number(f.epsilon).number(f.r2).number(f.score).number(f.ceiling).number(f.duration).cell(f.timeLaw);
    table.number(f.plan.value_or(kNotMeasured)).number(f.handMass.value_or(kNotMeasured));
    count(table, f.trials).whole(f.decided);
    sheet.endRow();
  }
  sheet.flush();
}

void fitTrialsTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "fit_trials.csv",
              {"condition", "subject", "session", "run", "trial", "fold", "criterion", "onset_s", "duration_s", "amplitude_m_per_s",
               "epsilon_fit_m_per_s", "r2", "score"});
  TableText& table = sheet.table;
  for (const PersonResult& person : study.people) {
    if (!person.fitted) continue;
    const auto& candidates = study.results[person.condition].candidates.candidates;
    std::size_t place = 0;
    for (std::size_t i = person.firstTrial; place < person.trials; ++i) {
      const StudyTrial& t = study.trials[i];
      if (!t.used() || t.window.size == 0) continue;
      for (std::size_t k = 0; k < candidates.size(); ++k) {
        const CandidateFit& fit = person.fit.candidates[k];
        const MovementFit& at = fit.trials[place];
        table.cell(study.conditions[t.condition].name).cell(t.key.subject).cell(t.key.session).whole(t.key.run).whole(t.key.trial);
        count(table, place % kFolds).cell(nameOfCandidate(candidates[k].criteria));
        table.number(at.found ? at.onset : kNotMeasured).number(at.found ? at.duration : kNotMeasured);
        table.number(at.found ? at.amplitude : kNotMeasured).number(fit.epsilon[place]);
        table.number(at.found ? 1 - at.cost / person.rest[place] : kNotMeasured).number(fit.score[place]);
        sheet.endRow();
      }
      ++place;
    }
  }
  sheet.flush();
}

void addConclusion(Sheet& sheet, const std::string& condition, const Conclusion& c,
                   const std::vector<std::vector<predict::Criterion>>& candidates) {
  TableText& table = sheet.table;
  for (std::size_t k = 0; k < c.score.size(); ++k) {
    table.cell(condition).cell(c.overSubjects ? "subjects" : "trials").cell(nameOfCandidate(candidates[k])).number(c.score[k]);
    const bool best = k == *c.best;
    table.number(best ? 0 : c.against[k].mean).number(best ? kNotMeasured : c.against[k].p);
    table.number(c.posterior.empty() ? kNotMeasured : c.posterior[k]).cell(best ? "yes" : "no").whole(c.follows && *c.follows == k);
    table.cell(c.decided() ? "" : nameOf(c.reason)).number(c.level);
    count(table, c.subjects);
    count(table, c.trials);
    sheet.endRow();
  }
}

void conclusionsTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "conclusions.csv",
              {"condition", "unit", "criterion", "score", "score_above_best", "p", "posterior", "best", "decided", "reason", "level",
               "subjects", "trials"});
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    std::vector<std::vector<predict::Criterion>> names;
    for (const Candidate& candidate : study.results[c].candidates.candidates) names.push_back(candidate.criteria);
    addConclusion(sheet, study.conditions[c].name, study.results[c].conclusion, names);
  }
  addConclusion(sheet, "all", study.overall, study.common);
  sheet.flush();
}

void successTableText(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "success_table.csv",
              {"subject", "day", "condition", "successes", "trials", "success_percent", "low_percent", "high_percent"});
  TableText& table = sheet.table;
  for (const SuccessCell& cell : study.success) {
    table.cell(cell.subject).whole(cell.day).cell(study.conditions[cell.condition].name);
    count(table, cell.successes);
    count(table, cell.trials).number(100.0 * static_cast<double>(cell.successes) / static_cast<double>(cell.trials));
    table.number(100 * cell.interval.low).number(100 * cell.interval.high);
    sheet.endRow();
  }
  sheet.flush();
}

void learningTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "learning.csv",
              {"subject", "session", "condition", "first_trial", "last_trial", "successes", "trials", "success_percent", "low_percent",
               "high_percent"});
  TableText& table = sheet.table;
  for (const LearningPoint& p : study.learning) {
    table.cell(p.subject).cell(p.session).cell(study.conditions[p.condition].name).whole(p.firstTrial).whole(p.lastTrial);
    count(table, p.successes);
    count(table, p.trials).number(100.0 * static_cast<double>(p.successes) / static_cast<double>(p.trials));
    table.number(100 * p.interval.low).number(100 * p.interval.high);
    sheet.endRow();
  }
  sheet.flush();
}

void effectsTable(const StudyResult& study, const TableWriter& write) {
  Sheet sheet(write, "effects.csv",
              {"effect", "condition", "from", "to", "subjects", "difference_percent", "low_percent", "high_percent", "odds_ratio",
               "odds_ratio_low", "odds_ratio_high", "p"});
  TableText& table = sheet.table;
  for (const Effect& e : study.effects) {
    const auto place = [&](int i) { return e.ofDay ? "D" + std::to_string(i) : study.conditions[static_cast<std::size_t>(i)].name; };
    table.cell(e.ofDay ? "day" : "condition").cell(e.ofDay ? study.conditions[e.condition].name : "").cell(place(e.from)).cell(place(e.to));
    count(table, e.people).number(e.points.mean).number(e.pointsInterval.low).number(e.pointsInterval.high);
    table.number(std::exp(e.logit.mean)).number(std::exp(e.logitInterval.low)).number(std::exp(e.logitInterval.high));
    table.number(e.people > 1 ? e.p : kNotMeasured);
    sheet.endRow();
  }
  for (const LearningSlope& s : study.slopes) {
    table.cell("slope").cell(study.conditions[s.condition].name).cell("").cell("");
    count(table, s.people).number(s.perHundred).number(s.interval.low).number(s.interval.high).missing().missing().missing();
    table.number(s.people > 1 ? s.p : kNotMeasured);
    sheet.endRow();
  }
  sheet.flush();
}

void conditionsTable(const StudyResult& study, const TableWriter& write) {
  const StudyOptions& o = study.options;
  Sheet sheet(write, "conditions.csv",
              {"condition",
               "experiment",
               "task_duration_s",
               "success",
               "failure",
               "aborted",
               "interrupted",
               "invalid_timing",
               "practice",
               "catch",
               "before_go",
               "other_way",
               "used",
               "used_outcome",
               "mean_duration_s",
               "sd_duration_s",
               "mean_movement_time_s",
               "sd_movement_time_s",
               "least_movement_time_s",
               "largest_movement_time_s",
               "onset_rule",
               "onset_percent",
               "onset_speed_m_per_s",
               "cutoff_hz",
               "hand_mass_kg",
               "hand_masses_tried_kg",
               "hand_damping_n_s_per_m"});
  TableText& table = sheet.table;
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const ConditionResult& r = study.results[c];
    const experiment::Experiment& e = study.conditions[c].experiment();
    table.cell(study.conditions[c].name).cell(e.name).number(e.task ? e.task->duration : kNotMeasured);
    for (const std::size_t n : {r.counts.success, r.counts.failure, r.counts.aborted, r.counts.interrupted, r.counts.invalidTiming,
                                r.counts.practice, r.counts.catchTrials, r.counts.beforeGo, r.counts.otherWay, r.used})
      count(table, n);
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
    sheet.endRow();
  }
  sheet.flush();
}

}  // namespace

std::string nameOfCandidate(const std::vector<predict::Criterion>& criteria) {
  return criteria.empty() ? "reference" : std::string(predict::nameOf(criteria.front()));
}

std::vector<FitRow> fitRows(const StudyResult& study) {
  std::vector<FitRow> rows;
  for (const PersonResult& person : study.people) {
    if (!person.fitted) continue;
    const auto& candidates = study.results[person.condition].candidates.candidates;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const CandidateFit& fit = person.fit.candidates[k];
      FitRow row;
      row.subject = person.subject;
      row.condition = study.conditions[person.condition].name;
      row.criterion = nameOfCandidate(candidates[k].criteria);
      for (std::size_t i = 1; i < candidates[k].criteria.size(); ++i)
        row.equivalent.emplace_back(predict::nameOf(candidates[k].criteria[i]));
      row.epsilon = fit.epsilonOfAll;
      row.r2 = fit.r2;
      row.score = fit.meanScore;
      row.ceiling = person.fit.own.ceiling;
      row.duration = fit.duration;
      row.timeLaw = candidates[k].reference() ? "" : nameOf(fit.choice.law);
      if (fit.choice.law == TimeLaw::OnePlan) row.plan = fit.choice.plan;
      if (!candidates[k].masses.empty()) row.handMass = candidates[k].masses[fit.choice.family];
      row.trials = person.trials;
      row.decided = person.follows && *person.follows == k;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

PredictedCurve curveOf(const ConditionResult& result, std::size_t criterion) {
  constexpr std::size_t kPoints = 201;
  const predict::Prediction& p = *result.predictions[criterion];
  const PredictedSignal& signal = result.signals[criterion];
  PredictedCurve curve;
  curve.hand.resize(kPoints);
  curve.object.resize(kPoints);
  p.sampleVelocities(curve.hand, curve.object);
  for (std::size_t i = 0; i < kPoints; ++i)
    curve.time.push_back(p.duration * static_cast<double>(i) / static_cast<double>(kPoints - 1) - (signal.onset - signal.begin));
  return curve;
}

void writeTables(const StudyResult& study, const TableWriter& write) {
  trialsTable(study, write);
  profilesTable(study, write);
  meanProfilesTable(study, write);
  predictionsTable(study, write);
  rankingTable(study, write);
  seriesTable(study, write);
  fitsTable(study, write);
  fitTrialsTable(study, write);
  conclusionsTable(study, write);
  successTableText(study, write);
  learningTable(study, write);
  effectsTable(study, write);
  conditionsTable(study, write);
}

std::string numberedName(predict::Criterion criterion) {
  static constexpr std::array<const char*, predict::kCriterionCount> kNumbers{"(1)", "(2)", "(3)", "(4)", "(5)", "(6)", "(3h)"};
  return std::string(kNumbers[static_cast<std::size_t>(criterion)]) + " " + std::string(nameOf(criterion));
}

std::string columnOf(predict::Criterion criterion) {
  std::string name(nameOf(criterion));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string fileNameOf(const std::string& condition) {
  std::string name;
  for (const char c : condition) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain) name += c;
    else if (!name.empty() && name.back() != '-') name += '-';
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "condition" : name;
}

}  // namespace reachlab::analysis
