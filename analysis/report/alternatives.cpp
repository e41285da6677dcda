#include "analysis/report/alternatives.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/report/wording.h"
#include "analysis/sheet.h"

namespace reachlab::analysis {
namespace {

constexpr const char* kAsAsked = "as asked";

}  // namespace

std::vector<Alternative> alternativesTo(const AnalysisOptions& asked) {
  std::vector<Alternative> out;
  const auto add = [&](std::string choice, auto change) {
    out.push_back({std::move(choice), asked});
    out.back().options.keepScatter = false;
    change(out.back().options);
  };
  for (const double cutoff : {6.0, 10.0, 15.0})
    if (cutoff != asked.measure.cutoff) add(fmt::format("cut-off {} Hz", cutoff), [&](AnalysisOptions& o) { o.measure.cutoff = cutoff; });
  const OnsetRule other = asked.measure.onset.rule == OnsetRule::Absolute ? OnsetRule::Percent : OnsetRule::Absolute;
  add(other == OnsetRule::Absolute ? fmt::format("onset at {} m/s", asked.measure.onset.speed)
                                   : fmt::format("onset at {} % of the peak", asked.measure.onset.percent),
      [&](AnalysisOptions& o) { o.measure.onset.rule = other; });
  if (!asked.handMass) {
    const double most = *std::max_element(asked.handMasses.begin(), asked.handMasses.end());
    for (const double share : {0.5, 2.0})
      add(fmt::format("hand masses up to {} kg", share * most), [&](AnalysisOptions& o) {
        for (double& mass : o.handMasses) mass *= share;
      });
  }
  if (!asked.includeFailures) add("with failed trials", [](AnalysisOptions& o) { o.includeFailures = true; });
  if (!asked.includePractice) add("with practice trials", [](AnalysisOptions& o) { o.includePractice = true; });
  const std::vector<predict::Criterion> compared = predict::orAll(asked.criteria);
  if (compared.size() > 2)
    for (const predict::Criterion left : compared)
      add(fmt::format("without {}", predict::nameOf(left)), [&](AnalysisOptions& o) {
        o.criteria = compared;
        std::erase(o.criteria, left);
      });
  return out;
}

std::string AlternativeConclusion::criterion() const { return conclusion.follows ? nameOfCandidate(candidates[*conclusion.follows]) : ""; }
std::string AlternativeConclusion::best() const { return conclusion.best ? nameOfCandidate(candidates[*conclusion.best]) : ""; }

std::vector<AlternativeConclusion> conclusionsOf(const Analysis& analysis, const std::string& choice) {
  std::vector<AlternativeConclusion> rows{{choice, kAllTogether, analysis.overall, analysis.common}};
  if (analysis.conditions.size() > 1)
    for (std::size_t c = 0; c < analysis.conditions.size(); ++c)
      rows.push_back({choice, analysis.conditions[c].name, analysis.results[c].conclusion, namesOf(analysis.results[c].candidates)});
  return rows;
}

void addAlternatives(Analysis& analysis, std::vector<AlternativeConclusion> others) {
  analysis.alternatives = conclusionsOf(analysis, kAsAsked);
  const std::vector<AlternativeConclusion> asked = analysis.alternatives;
  for (AlternativeConclusion& row : others) {
    const auto same = std::find_if(asked.begin(), asked.end(), [&](const auto& a) { return a.condition == row.condition; });
    row.changed = same != asked.end() && same->criterion() != row.criterion();
    analysis.alternatives.push_back(std::move(row));
  }
}

std::string describeAlternatives(const Analysis& analysis) {
  std::size_t all = 0, changed = 0;
  std::string differ;
  for (const AlternativeConclusion& row : analysis.alternatives) {
    if (row.condition != kAllTogether || row.choice == kAsAsked) continue;
    ++all;
    changed += row.changed;
    if (row.changed)
      differ += fmt::format("{}{}: {}", differ.empty() ? " The others are: " : "; ", row.choice,
                            row.criterion().empty() ? fmt::format("undecided ({})", nameOf(row.conclusion.reason)) : row.criterion());
  }
  if (all == 0) return {};
  return fmt::format("The conclusion is the same in {} of {} analyses with another choice.{}", all - changed, all,
                     differ.empty() ? "" : differ + ".");
}

namespace {

void alternativeRows(const Analysis& analysis, Sheet& table) {
  for (const AlternativeConclusion& row : analysis.alternatives)
    table.row(row.choice, row.condition, row.criterion(), nameOf(row.conclusion.reason), row.best(), row.p(), row.changed);
}

}  // namespace

std::string alternativesTable(const Analysis& analysis) { return sheetText("alternatives.csv", analysis, alternativeRows); }

}  // namespace reachlab::analysis
