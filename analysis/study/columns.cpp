#include "analysis/study/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/study/points.h"
#include "analysis/study/trial_row.h"
#include "analysis/table_columns.h"
#include "analysis/tables.h"
#include "base/number_range.h"
#include "sim/record/export/column_dictionary.h"
#include "sim/record/log/trial_measures.h"
#include "sim/session/block_scenes.h"

namespace reachlab::study {
namespace {

/// A measure of a study: one of the ticks, or one of the analysis, which needs the samples.
struct StudyMeasure {
  std::string_view name, sentence;
  const record::TickMeasure* ofTicks = nullptr;
  const analysis::Measure* ofSamples = nullptr;
  double of(const MeasuredTrial& t) const { return ofTicks != nullptr ? ofTicks->of(t.recorded) : t.measures.*ofSamples->value; }
};

/// The ticks' measures go first: what has one name is one quantity, and theirs needs no samples.
const std::vector<StudyMeasure>& studyMeasures() {
  static const auto kMeasures = [] {
    std::vector<StudyMeasure> all;
    for (const record::TickMeasure& m : record::tickMeasures())
      if (!m.ofComputer) all.push_back({m.name, m.sentence, &m, nullptr});
    for (const analysis::Measure& m : analysis::measures())
      if (std::none_of(all.begin(), all.end(), [&](const StudyMeasure& known) { return known.name == m.name; }))
        all.push_back({m.name, m.sentence, nullptr, &m});
    return all;
  }();
  return kMeasures;
}

const StudyMeasure* findMeasure(std::string_view name) {
  const auto at = std::find_if(studyMeasures().begin(), studyMeasures().end(), [&](const StudyMeasure& m) { return name == m.name; });
  return at == studyMeasures().end() ? nullptr : &*at;
}

const std::vector<std::string>& measuresOf(const Design& design) {
  static const std::vector<std::string> usual = usualMeasures();
  return design.measures.empty() ? usual : design.measures;
}

bool asksFor(const Design& design, const char* family) {
  return std::find(design.measures.begin(), design.measures.end(), family) != design.measures.end();
}

std::vector<std::string> allCriteria() {
  std::vector<std::string> names;
  for (const predict::Criterion criterion : predict::kAllCriteria) names.emplace_back(predict::nameOf(criterion));
  return names;
}

constexpr int kOutcomes = static_cast<int>(trial::Outcome::Interrupted) + 1, kReasons = static_cast<int>(trial::kLastReason) + 1;

Column columnOf(const VariedKey& axis) {
  Column column{axis.path, {}};
  const bool numbers = std::all_of(axis.values.begin(), axis.values.end(),
                                   [](const std::string& v) { return v.find_first_of("\"[{tfn") == std::string::npos; });
  if (!numbers)
    for (const std::string& value : axis.values) column.words.push_back(unquoted(value));
  return column;
}

std::vector<std::string> conditionsOf(const Design& design) {
  std::vector<std::string> names;
  for (const session::PlanBlock& block : session::parsePlan(design.planText, design.plan).blocks) {
    for (const session::SceneName& scene : session::sceneNames(block))
      if (std::find(names.begin(), names.end(), scene.condition) == names.end()) names.push_back(scene.condition);
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
    if (const StudyMeasure* measure = findMeasure(name); measure != nullptr && measure->ofSamples != nullptr) needs.samples = true;
  return needs;
}

std::vector<predict::Criterion> criteriaOf(const Design& design) {
  std::vector<predict::Criterion> named;
  for (const std::string& name : design.criteria) named.push_back(*predict::criterionFromName(name));
  return predict::orAll(named);
}

std::size_t identityColumns(const Design& design) {
  return (design.planText.empty() ? column::Session : column::EndOfPlan) + 2 + design.axes.size();
}

std::vector<Column> columnsOf(const Design& design) {
  std::vector<Column> columns{{"point", {}}, {"subject", {}}};
  if (!design.planText.empty()) {
    columns.push_back({"session", {}});
    columns.push_back({"day", {}});
    columns.push_back({"block", {}});
    columns.push_back({"condition", conditionsOf(design)});
    columns.push_back({"practice", {}});
    columns.push_back({"catch_trial", {}});
  }
  columns.push_back({"trial", {}});
  columns.push_back({"seed", {}});
  for (const VariedKey& axis : design.axes) columns.push_back(columnOf(axis));
  Column outcome{"outcome", {}}, reason{"reason", {}};
  for (int i = 0; i < kOutcomes; ++i) outcome.words.emplace_back(trial::nameOf(static_cast<trial::Outcome>(i)));
  for (int i = 0; i < kReasons; ++i) reason.words.emplace_back(i == 0 ? "" : trial::nameOf(static_cast<trial::Reason>(i)));
  columns.push_back(std::move(outcome));
  columns.push_back(std::move(reason));
  for (const std::string& name : measuresOf(design)) {
    if (name == "epsilon") {
      for (const char* what : {"hand", "object"})
        for (const predict::Criterion criterion : criteriaOf(design))
          columns.push_back({fmt::format("epsilon_{}_{}_m_per_s", what, analysis::underscored(nameOf(criterion))), {}});
    } else if (name == "score") {
      for (const predict::Criterion criterion : criteriaOf(design))
        columns.push_back({"score_" + analysis::underscored(nameOf(criterion)), {}});
      columns.push_back({"score_reference", {}});
      columns.push_back({"fit_effective_samples", {}});
      columns.push_back({"fit_own_score", {}});
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
  for (const StudyMeasure& measure : studyMeasures()) names.emplace_back(measure.name);
  names.insert(names.end(), {"epsilon", "score"});
  return names;
}

std::vector<std::string> usualMeasures() {
  return {"mass",        "by",           "movement_time_s", "task_reaction_time_s", "peak_hand_speed_m_per_s",
          "hand_path_m", "peak_force_n", "mean_force_n",    "clamped_ticks"};
}

std::vector<Fault> measureProblems(const Design& design) {
  std::vector<Fault> faults;
  const auto check = [&](const char* key, const std::vector<std::string>& names, const std::vector<std::string>& allowed) {
    for (auto name = names.begin(); name != names.end(); ++name) {
      const std::string place = fmt::format("{}[{}]", key, name - names.begin());
      checkChoice(place, *name, allowed, faults);
      if (std::find(names.begin(), name, *name) != name)
        faults.push_back({place, fmt::format("\"{}\" stands here twice", *name), "each once"});
    }
  };
  check("measures", design.measures, measureNames());
  check("criteria", design.criteria, allCriteria());
  return faults;
}

std::string dictionaryOf(const Design& design) {
  std::string header;
  for (const Column& column : columnsOf(design)) header += (header.empty() ? "" : ",") + column.name;
  std::vector<record::ColumnMeaning> meanings;  // the first of a name holds
  for (const VariedKey& key : design.axes) meanings.push_back({key.path, "Varied by the study"});
  meanings.insert(
      meanings.end(),
      {{"point", "Point of the study, from 0: one combination of what is varied"},
       {"subject", "Virtual subject of the point, from 1"},
       {"session", "Session of the plan: its day"},
       {"practice", "1: a practice block"},
       {"catch_trial", "1: no go signal was given, and moving was the failure"},
       {"seed", "Seed of the subject's session: a recorded run of the point's experiment with it repeats the trials"},
       {"score_*", "ln S of the candidate that the column names, held out: lower is nearer. The reference ignores the object"},
       {"fit_effective_samples", "Independent samples in a trial of this subject and block, by its residuals' correlation"},
       {"fit_own_score",
        "ln S of the trial for the mean of the subject's other trials: above it by more than chance, a candidate does not fit"}});
  for (const StudyMeasure& measure : studyMeasures()) meanings.push_back({measure.name, measure.sentence});
  const std::span<const record::ColumnMeaning> trials = analysis::tableColumns("trials.csv");
  meanings.insert(meanings.end(), trials.begin(), trials.end());
  auto dictionary = nlohmann::ordered_json::parse(record::columnDictionary(header, meanings));
  for (auto& [name, entry] : dictionary.items()) {
    if (name == "subject") entry.erase("Format");  // a number here
    if (name.starts_with("score_")) entry.erase("Units");
  }
  return dictionary.dump(2) + "\n";
}

}  // namespace reachlab::study
