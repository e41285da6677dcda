#include "analysis/study/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/study/trial_row.h"
#include "analysis/tables.h"
#include "base/number_range.h"
#include "sim/predict/prediction/criterion.h"
#include "sim/record/export/column_dictionary.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/trial_measures.h"
#include "sim/session/plan.h"

namespace reachlab::study {
namespace {

struct Measure {
  const char* name;
  bool samples;  // of the analysis, else as `reach export` has it
  double (*of)(const MeasuredTrial&);
};

constexpr Measure kMeasures[] = {
    {"mass", false, [](const MeasuredTrial& t) { return static_cast<double>(t.recorded.result.mass); }},
    {"by", false, [](const MeasuredTrial& t) { return t.recorded.result.by; }},
    {"movement_time_s", false, [](const MeasuredTrial& t) { return record::movementTimeOf(t.recorded); }},
    {"reaction_time_s", false, [](const MeasuredTrial& t) { return record::timesOf(t.recorded).reaction; }},
    {"peak_hand_speed_m_per_s", false, [](const MeasuredTrial& t) { return t.recorded.peakHandSpeed; }},
    {"hand_path_m", false, [](const MeasuredTrial& t) { return t.recorded.handPathLength; }},
    {"peak_force_n", false, [](const MeasuredTrial& t) { return t.recorded.peakForce; }},
    {"mean_force_n", false, [](const MeasuredTrial& t) { return t.recorded.meanForce; }},
    {"clamped_ticks", false, [](const MeasuredTrial& t) { return static_cast<double>(t.recorded.clampedTicks); }},
    {"onset_s", true, [](const MeasuredTrial& t) { return t.measures.onset; }},
    {"offset_s", true, [](const MeasuredTrial& t) { return t.measures.offset; }},
    {"duration_s", true, [](const MeasuredTrial& t) { return t.measures.duration; }},
    {"peak_speed_m_per_s", true, [](const MeasuredTrial& t) { return t.measures.peakSpeed; }},
    {"time_to_peak_s", true, [](const MeasuredTrial& t) { return t.measures.timeToPeak; }},
    {"time_to_peak_percent", true, [](const MeasuredTrial& t) { return t.measures.timeToPeakPercent; }},
    {"symmetry_ratio", true, [](const MeasuredTrial& t) { return t.measures.symmetryRatio; }},
    {"path_length_m", true, [](const MeasuredTrial& t) { return t.measures.pathLength; }},
    {"speed_peaks", true, [](const MeasuredTrial& t) { return t.measures.speedPeaks; }},
    {"hand_endpoint_error_m", true, [](const MeasuredTrial& t) { return t.measures.handEndpointError; }},
    {"object_endpoint_error_m", true, [](const MeasuredTrial& t) { return t.measures.objectEndpointError; }},
    {"hand_overshoot_m", true, [](const MeasuredTrial& t) { return t.measures.handOvershoot; }},
    {"object_overshoot_m", true, [](const MeasuredTrial& t) { return t.measures.objectOvershoot; }},
    {"sparc", true, [](const MeasuredTrial& t) { return t.measures.sparc; }},
    {"ldlj", true, [](const MeasuredTrial& t) { return t.measures.ldlj; }},
};

const Measure* findMeasure(const std::string& name) {
  const auto at = std::find_if(std::begin(kMeasures), std::end(kMeasures), [&](const Measure& m) { return name == m.name; });
  return at == std::end(kMeasures) ? nullptr : &*at;
}

const std::vector<std::string>& measuresOf(const Design& design) {
  static const std::vector<std::string> usual = usualMeasures();
  return design.measures.empty() ? usual : design.measures;
}

bool asksFor(const Design& design, const char* family) {
  return std::find(design.measures.begin(), design.measures.end(), family) != design.measures.end();
}

std::string underscored(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

constexpr int kOutcomes = static_cast<int>(trial::Outcome::Interrupted) + 1, kReasons = static_cast<int>(trial::kLastReason) + 1;

std::string plainWord(const std::string& json) { return json.size() > 1 && json.front() == '"' ? json.substr(1, json.size() - 2) : json; }

Column columnOf(const Axis& axis) {
  Column column{axis.path, {}};
  const bool numbers = std::all_of(axis.values.begin(), axis.values.end(),
                                   [](const std::string& v) { return v.find_first_of("\"[{tfn") == std::string::npos; });
  if (!numbers)
    for (const std::string& value : axis.values) column.words.push_back(plainWord(value));
  return column;
}

std::vector<std::string> conditionsOf(const Design& design) {
  std::vector<std::string> names;
  for (const session::PlanBlock& block : session::parsePlan(design.planText, design.plan).blocks) {
    std::string name = conditionOf(block);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

Needs needsOf(const Design& design) {
  Needs needs;
  needs.errors = asksFor(design, "epsilon");
  needs.fits = asksFor(design, "score");
  needs.samples = needs.errors || needs.fits || design.profiles;
  for (const std::string& name : design.measures)
    if (const Measure* measure = findMeasure(name); measure != nullptr && measure->samples) needs.samples = true;
  return needs;
}

std::vector<std::string> criteriaOf(const Design& design) {
  if (!design.criteria.empty()) return design.criteria;
  std::vector<std::string> all;
  for (int i = 0; i < predict::kCriterionCount; ++i) all.emplace_back(predict::nameOf(static_cast<predict::Criterion>(i)));
  return all;
}

std::size_t identityColumns(const Design& design) { return (design.planText.empty() ? 4 : 9) + design.axes.size(); }

std::vector<Column> columnsOf(const Design& design) {
  std::vector<Column> columns{{"point", {}}, {"subject", {}}};
  if (!design.planText.empty()) {
    columns.push_back({"session", {}});
    columns.push_back({"day", {}});
    columns.push_back({"block", {}});
    columns.push_back({"condition", conditionsOf(design)});
    columns.push_back({"practice", {}});
  }
  columns.push_back({"trial", {}});
  columns.push_back({"seed", {}});
  for (const Axis& axis : design.axes) columns.push_back(columnOf(axis));
  Column outcome{"outcome", {}}, reason{"reason", {}};
  for (int i = 0; i < kOutcomes; ++i) outcome.words.emplace_back(trial::nameOf(static_cast<trial::Outcome>(i)));
  for (int i = 0; i < kReasons; ++i) reason.words.emplace_back(i == 0 ? "" : trial::nameOf(static_cast<trial::Reason>(i)));
  columns.push_back(std::move(outcome));
  columns.push_back(std::move(reason));
  for (const std::string& name : measuresOf(design)) {
    if (name == "epsilon") {
      for (const char* what : {"hand", "object"})
        for (const std::string& criterion : criteriaOf(design))
          columns.push_back({fmt::format("epsilon_{}_{}_m_per_s", what, underscored(criterion)), {}});
    } else if (name == "score") {
      for (const std::string& criterion : criteriaOf(design)) columns.push_back({"score_" + underscored(criterion), {}});
      columns.push_back({"score_reference", {}});
      columns.push_back({"fit_effective_samples", {}});
      columns.push_back({"fit_poorness", {}});
    } else {
      columns.push_back({name, {}});
    }
  }
  return columns;
}

void putMeasures(const Design& design, const MeasuredTrial& trial, std::span<double> row) {
  std::size_t at = identityColumns(design);
  row[at++] = static_cast<double>(trial.recorded.result.outcome);
  row[at++] = static_cast<double>(trial.recorded.result.reason);
  const auto putAll = [&](const std::vector<double>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) row[at++] = i < values.size() ? values[i] : analysis::kNotMeasured;
  };
  for (const std::string& name : measuresOf(design)) {
    const std::size_t criteria = name == "epsilon" || name == "score" ? criteriaOf(design).size() : 0;
    if (name == "epsilon") putAll(trial.epsilonHand, criteria), putAll(trial.epsilonObject, criteria);
    else if (name == "score") putAll(trial.score, criteria + 3);
    else row[at++] = findMeasure(name)->of(trial);
  }
}

std::vector<std::string> measureNames() {
  std::vector<std::string> names;
  for (const Measure& measure : kMeasures) names.emplace_back(measure.name);
  names.insert(names.end(), {"epsilon", "score"});
  return names;
}

std::vector<std::string> usualMeasures() {
  std::vector<std::string> names;
  for (const Measure& measure : kMeasures)
    if (!measure.samples) names.emplace_back(measure.name);
  return names;
}

std::vector<Fault> measureProblems(const Design& design) {
  std::vector<Fault> faults;
  const std::vector<std::string> known = measureNames();
  std::vector<std::string> seen;
  for (std::size_t i = 0; i < design.measures.size(); ++i) {
    const std::string& name = design.measures[i];
    checkChoice(fmt::format("measures[{}]", i), name, known, faults);
    if (std::find(seen.begin(), seen.end(), name) != seen.end())
      faults.push_back({fmt::format("measures[{}]", i), fmt::format("\"{}\" stands here twice", name), "each measure once"});
    seen.push_back(name);
  }
  std::vector<std::string> criteria;
  for (int i = 0; i < predict::kCriterionCount; ++i) criteria.emplace_back(predict::nameOf(static_cast<predict::Criterion>(i)));
  for (std::size_t i = 0; i < design.criteria.size(); ++i)
    checkChoice(fmt::format("criteria[{}]", i), design.criteria[i], criteria, faults);
  return faults;
}

std::string dictionaryOf(const Design& design) {
  using Json = nlohmann::ordered_json;
  std::string header;
  for (const Column& column : columnsOf(design)) header += (header.empty() ? "" : ",") + column.name;
  header += "\n";
  static constexpr record::ColumnMeaning kOwn[] = {
      {"point", "Point of the study, from 0: one combination of what is varied"},
      {"subject", "Virtual subject of the point, from 1"},
      {"session", "Session of the plan: its day"},
      {"practice", "1: a practice block"},
      {"seed", "Seed of the subject's session: a recorded run of the point's experiment with it repeats the trials"},
      {"trials", "Trials of each subject, varied"},
      {"score_*", "ln S of the candidate that the column names, held out: lower is nearer. The reference ignores the object"},
      {"fit_effective_samples", "Independent samples in a trial of this subject and block, by its residuals' correlation"},
      {"fit_poorness", "R^2 of the mean of the subject's other trials less that of the subject's nearest candidate"},
      {"by", "Excess over the tolerance that was missed: m where reason is position, m/s where velocity, s where time_short"}};
  Json dictionary = Json::parse(record::columnDictionary(header, kOwn));
  const Json analysis = Json::parse(analysis::tableDictionary("trials.csv", header)), tidy = Json::parse(record::trialsDictionary(header));
  for (auto& [name, entry] : dictionary.items()) {
    const Measure* measure = findMeasure(name);
    const bool ofAnalysis = (measure != nullptr && measure->samples) || name.starts_with("epsilon_");
    std::string& text = entry["Description"].get_ref<std::string&>();
    if (text.empty()) text = (ofAnalysis ? analysis : tidy)[name]["Description"].get<std::string>();
    for (const Axis& axis : design.axes)
      if (axis.path == name) text = "Varied by the study";
    if (name == "subject") entry.erase("Format");
    if (name.starts_with("score_") || name == "by") entry.erase("Units");
  }
  return dictionary.dump(2) + "\n";
}

}  // namespace reachlab::study
