#include "sim/analyze/tables.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/table_text.h"

namespace reachlab::analyze {
namespace {

TableText csv(const std::vector<std::string>& columns) {
  TableText table(',', "");
  table.row(columns);
  return table;
}

TableText& count(TableText& table, std::size_t n) { return table.whole(static_cast<long long>(n)); }

/// Criteria that were predicted in any condition, in the paper's order: the columns of the trial and series tables.
std::vector<predict::Criterion> allCriteria(const StudyResult& study) {
  std::vector<predict::Criterion> out;
  for (int i = 0; i < predict::kCriterionCount; ++i)
    for (const ConditionResult& result : study.results)
      if (std::any_of(result.predictions.begin(), result.predictions.end(),
                      [&](const PredictedProfile& p) { return p.criterion == static_cast<predict::Criterion>(i); })) {
        out.push_back(static_cast<predict::Criterion>(i));
        break;
      }
  return out;
}

double errorFor(const std::vector<double>& errors, const ConditionResult& result, predict::Criterion criterion) {
  for (std::size_t k = 0; k < result.predictions.size() && k < errors.size(); ++k)
    if (result.predictions[k].criterion == criterion) return errors[k];
  return kNotMeasured;
}

std::string trialsTable(const StudyResult& study) {
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
  const std::vector<predict::Criterion> criteria = allCriteria(study);
  for (const char* what : {"hand", "object"})
    for (const predict::Criterion c : criteria) columns.push_back(std::string("epsilon_") + what + "_" + columnOf(c) + "_m_per_s");
  TableText table = csv(columns);
  for (const StudyTrial& t : study.trials) {
    table.cell(t.key.subject).cell(t.key.session).whole(t.key.run).whole(t.key.block).whole(t.key.trial).whole(t.key.day);
    table.cell(study.conditions[t.condition].name).cell(t.practice ? "practice" : "recorded").cell(trial::nameOf(t.result.outcome));
    table.cell(t.result.reason == trial::Reason::None ? "" : trial::nameOf(t.result.reason))
        .whole(t.result.mass)
        .number(t.result.by)
        .whole(t.used());
    table.cell(t.exclusion);
    const TrialMeasures& m = t.measures;
    for (const double v : {m.reactionTime, m.onset, m.offset, m.duration, m.movementTime, m.peakSpeed, m.timeToPeak, m.timeToPeakPercent,
                           m.symmetryRatio, m.pathLength, m.speedPeaks, m.handEndpointError, m.objectEndpointError, m.handOvershoot,
                           m.objectOvershoot, m.sparc, m.ldlj, m.peakForce, m.meanForce})
      table.number(v);
    for (const auto* errors : {&t.handError, &t.objectError})
      for (const predict::Criterion c : criteria) table.number(errorFor(*errors, study.results[t.condition], c));
    table.endRow();
  }
  return table.text();
}

std::string profilesTable(const StudyResult& study) {
  TableText table = csv({"condition", "subject", "session", "run", "trial", "percent", "time_s", "hand_m_per_s", "object_m_per_s"});
  for (const StudyTrial& t : study.trials) {
    if (!t.used()) continue;
    const double mean = study.results[t.condition].duration.mean, factor = t.measures.duration / mean;
    for (std::size_t i = 0; i < kProfilePoints; ++i) {
      table.cell(study.conditions[t.condition].name).cell(t.key.subject).cell(t.key.session).whole(t.key.run).whole(t.key.trial);
      table.whole(static_cast<long long>(i)).number(mean * static_cast<double>(i) / 100);
      table.number(factor * t.hand[i]).number(factor * t.object[i]).endRow();
    }
  }
  return table.text();
}

std::string meanProfilesTable(const StudyResult& study) {
  TableText table =
      csv({"condition", "percent", "time_s", "trials", "hand_mean_m_per_s", "hand_sd_m_per_s", "object_mean_m_per_s", "object_sd_m_per_s"});
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const ConditionResult& r = study.results[c];
    for (std::size_t i = 0; i < r.hand.mean.size(); ++i) {
      table.cell(study.conditions[c].name).whole(static_cast<long long>(i)).number(r.duration.mean * static_cast<double>(i) / 100);
      count(table, r.used).number(r.hand.mean[i]).number(r.hand.sd[i]).number(r.object.mean[i]).number(r.object.sd[i]).endRow();
    }
  }
  return table.text();
}

std::string predictionsTable(const StudyResult& study) {
  TableText table = csv({"condition", "criterion", "predicted_duration_s", "percent", "time_s", "hand_m_per_s", "object_m_per_s"});
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const ConditionResult& r = study.results[c];
    for (const PredictedProfile& p : r.predictions) {
      const double duration = r.used > 0 ? r.duration.mean : p.duration;
      for (std::size_t i = 0; i < kProfilePoints; ++i) {
        table.cell(study.conditions[c].name).cell(predict::nameOf(p.criterion)).number(p.taskDuration).whole(static_cast<long long>(i));
        table.number(duration * static_cast<double>(i) / 100).number(p.hand[i]).number(p.object[i]).endRow();
      }
    }
  }
  return table.text();
}

void addRanking(TableText& table, const std::string& condition, const char* signal, const char* over, const Ranking& ranking,
                const std::vector<predict::Criterion>& criteria) {
  int place = 0;
  for (const RankedCriterion& p : ranking.places) {
    table.cell(condition).cell(signal).cell(over).whole(++place).cell(predict::nameOf(criteria[p.criterion])).number(p.epsilon);
    table.number(p.interval.low).number(p.interval.high).number(p.difference).number(p.differenceInterval.low);
    table.number(p.differenceInterval.high).number(p.firstShare);
    table.cell(place == 1 ? "" : p.apartFromFirst ? "yes" : "no");
    std::string equals;
    for (const auto& [i, j] : ranking.ties) {
      const auto self = static_cast<std::size_t>(place - 1);
      if (i != self && j != self) continue;
      equals += (equals.empty() ? "" : ";") + std::string(predict::nameOf(criteria[ranking.places[i == self ? j : i].criterion]));
    }
    table.cell(equals);
    count(table, ranking.trials);
    count(table, ranking.subjects).endRow();
  }
}

std::string rankingTable(const StudyResult& study) {
  TableText table = csv({"condition", "signal", "bootstrap_over", "rank", "criterion", "epsilon_m_per_s", "epsilon_low_m_per_s",
                         "epsilon_high_m_per_s", "difference_m_per_s", "difference_low_m_per_s", "difference_high_m_per_s",
                         "share_of_resamples_first", "apart_from_first", "not_told_apart_from", "trials", "subjects"});
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const ConditionResult& r = study.results[c];
    std::vector<predict::Criterion> criteria;
    for (const PredictedProfile& p : r.predictions) criteria.push_back(p.criterion);
    const std::string& name = study.conditions[c].name;
    addRanking(table, name, "hand", "trials", r.handRanking, criteria);
    if (r.handOverSubjects) addRanking(table, name, "hand", "subjects", *r.handOverSubjects, criteria);
    addRanking(table, name, "object", "trials", r.objectRanking, criteria);
    if (r.objectOverSubjects) addRanking(table, name, "object", "subjects", *r.objectOverSubjects, criteria);
  }
  addRanking(table, "all", "hand", "trials", study.overall, study.common);
  if (study.overallOverSubjects) addRanking(table, "all", "hand", "subjects", *study.overallOverSubjects, study.common);
  return table.text();
}

std::string seriesTable(const StudyResult& study) {
  TableText table = csv({"subject", "session", "run", "block", "day", "condition", "signal", "criterion", "epsilon_m_per_s", "trials"});
  for (const SeriesResult& s : study.series) {
    const auto& predictions = study.results[s.condition].predictions;
    for (const auto& [signal, errors] : {std::pair{"hand", &s.handError}, std::pair{"object", &s.objectError}})
      for (std::size_t k = 0; k < predictions.size(); ++k) {
        table.cell(s.key.subject).cell(s.key.session).whole(s.key.run).whole(s.key.block).whole(s.key.day);
        table.cell(study.conditions[s.condition].name).cell(signal).cell(predict::nameOf(predictions[k].criterion)).number((*errors)[k]);
        count(table, s.trials).endRow();
      }
  }
  return table.text();
}

std::string successTableText(const StudyResult& study) {
  TableText table = csv({"subject", "day", "condition", "successes", "trials", "success_percent", "low_percent", "high_percent"});
  for (const SuccessCell& cell : study.success) {
    table.cell(cell.subject).whole(cell.day).cell(study.conditions[cell.condition].name);
    count(table, cell.successes);
    count(table, cell.trials).number(100.0 * static_cast<double>(cell.successes) / static_cast<double>(cell.trials));
    table.number(100 * cell.interval.low).number(100 * cell.interval.high).endRow();
  }
  return table.text();
}

std::string learningTable(const StudyResult& study) {
  TableText table = csv({"subject", "session", "condition", "first_trial", "last_trial", "successes", "trials", "success_percent",
                         "low_percent", "high_percent"});
  for (const LearningPoint& p : study.learning) {
    table.cell(p.subject).cell(p.session).cell(study.conditions[p.condition].name).whole(p.firstTrial).whole(p.lastTrial);
    count(table, p.successes);
    count(table, p.trials).number(100.0 * static_cast<double>(p.successes) / static_cast<double>(p.trials));
    table.number(100 * p.interval.low).number(100 * p.interval.high).endRow();
  }
  return table.text();
}

std::string conditionsTable(const StudyResult& study) {
  const StudyOptions& o = study.options;
  TableText table = csv({"condition",
                         "experiment",
                         "task_duration_s",
                         "success",
                         "failure",
                         "aborted",
                         "interrupted",
                         "practice",
                         "catch",
                         "used",
                         "used_outcome",
                         "mean_duration_s",
                         "sd_duration_s",
                         "mean_movement_time_s",
                         "sd_movement_time_s",
                         "onset_rule",
                         "onset_percent",
                         "onset_speed_m_per_s",
                         "cutoff_hz",
                         "hand_mass_kg",
                         "resamples",
                         "bootstrap_seed"});
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const ConditionResult& r = study.results[c];
    const experiment::Experiment& e = study.conditions[c].experiment;
    table.cell(study.conditions[c].name).cell(e.name).number(e.task ? e.task->duration : kNotMeasured);
    for (const std::size_t n :
         {r.counts.success, r.counts.failure, r.counts.aborted, r.counts.interrupted, r.counts.practice, r.counts.catchTrials, r.used})
      count(table, n);
    table.cell(r.used == 0      ? ""
               : r.onlyFailures ? "failure"
                                : "success")
        .number(r.duration.mean)
        .number(r.duration.sd)
        .number(r.movementTime.mean)
        .number(r.movementTime.sd);
    table.cell(nameOf(o.measure.onset.rule)).number(o.measure.onset.percent).number(o.measure.onset.speed).number(o.measure.cutoff);
    table.number(o.handMass.value_or(e.handMass)).whole(o.ranking.resamples).whole(static_cast<long long>(o.ranking.seed)).endRow();
  }
  return table.text();
}

}  // namespace

std::map<std::string, std::string> makeTables(const StudyResult& study) {
  return {{"trials.csv", trialsTable(study)},
          {"profiles.csv", profilesTable(study)},
          {"mean_profiles.csv", meanProfilesTable(study)},
          {"predictions.csv", predictionsTable(study)},
          {"ranking.csv", rankingTable(study)},
          {"series.csv", seriesTable(study)},
          {"success_table.csv", successTableText(study)},
          {"learning.csv", learningTable(study)},
          {"conditions.csv", conditionsTable(study)}};
}

std::string numberedName(predict::Criterion criterion) {
  static constexpr std::array<const char*, predict::kCriterionCount> kNumbers{"(1)", "(2)", "(3)", "(4)", "(5)", "(6)", "(3h)"};
  return std::string(kNumbers[static_cast<std::size_t>(criterion)]) + " " + std::string(predict::nameOf(criterion));
}

std::string columnOf(predict::Criterion criterion) {
  std::string name(predict::nameOf(criterion));
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

}  // namespace reachlab::analyze
