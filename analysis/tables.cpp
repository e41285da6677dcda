#include "analysis/tables.h"

#include <algorithm>
#include <array>

#include "analysis/sheet.h"

namespace reachlab::analysis {

std::string nameOfCandidate(const std::vector<predict::Criterion>& criteria) {
  return criteria.empty() ? "reference" : std::string(predict::nameOf(criteria.front()));
}

std::vector<FitRow> fitRows(const Analysis& analysis) {
  std::vector<FitRow> rows;
  for (const PersonResult& person : analysis.people) {
    if (!person.fitted) continue;
    const auto& candidates = analysis.results[person.condition].candidates.candidates;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const CandidateFit& fit = person.fit.candidates[k];
      const std::vector<predict::Criterion>& criteria = candidates[k].criteria;
      const Conclusion& c = person.conclusion;
      FitRow& row = rows.emplace_back();
      row.person = &person, row.fit = &fit;
      row.condition = analysis.conditions[person.condition].name;
      row.criterion = nameOfCandidate(criteria);
      for (std::size_t i = 1; i < criteria.size(); ++i) row.equivalent.emplace_back(predict::nameOf(criteria[i]));
      row.timeLaw = candidates[k].reference() ? "" : nameOf(fit.choice.law);
      if (fit.choice.law == TimeLaw::OnePlan) row.plan = fit.choice.plan;
      if (!candidates[k].masses.empty()) row.handMass = fit.choice.mass;
      row.misfit = fit.meanScore - person.fit.own.ceilingScore;
      if (c.best == k && c.mixedWith)
        row.toward = nameOfCandidate(candidates[*c.mixedWith].criteria), row.towardShare = c.mixture.mean, row.towardP = c.mixtureP;
      row.decided = c.follows == k;
    }
  }
  return rows;
}

PredictedCurve curveOf(const PredictedSignal& signal) {
  const predict::Prediction& p = *signal.prediction;
  constexpr std::size_t kPoints = 201;
  PredictedCurve curve;
  curve.hand.resize(kPoints);
  curve.object.resize(kPoints);
  p.sampleVelocities(curve.hand, curve.object);
  for (std::size_t i = 0; i < kPoints; ++i)
    curve.time.push_back(p.duration * static_cast<double>(i) / static_cast<double>(kPoints - 1) - (signal.onset - signal.begin));
  return curve;
}

void writeTables(const Analysis& analysis, const TableWriter& write) {
  writeTrialTables(analysis, write);
  writeConditionTables(analysis, write);
  writeAdaptationTable(analysis, write);
}

std::string numberedName(predict::Criterion criterion) {
  static constexpr std::array<const char*, predict::kCriterionCount> kNumbers{"(1)", "(2)", "(3)", "(4)", "(5)", "(6)", "(3h)"};
  return std::string(kNumbers[static_cast<std::size_t>(criterion)]) + " " + std::string(nameOf(criterion));
}

std::string underscored(std::string_view name) {
  std::string column(name);
  std::replace(column.begin(), column.end(), '-', '_');
  return column;
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
