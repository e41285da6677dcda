#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "analysis/adaptation/state_space.h"
#include "analysis/sheet.h"
#include "analysis/taught_trials.h"
#include "base/error.h"

namespace reachlab::analysis {
namespace {

constexpr int kResamples = 200;  // of the intervals

AdaptationTrial seen(const AnalyzedTrial& trial, bool rotated) {
  const auto known = [](double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; };
  if (rotated) return {trial.scene.rotation, known(-trial.measures.handAngle)};
  if (trial.scene.channel) return {std::nullopt, known(trial.measures.adaptation / 100)};
  return {trial.scene.inField ? 1.0 : 0.0, std::nullopt};
}

void row(Sheet& table, const std::string& subject, const std::string& block, const AdaptationSeries& series, bool rotated,
         const Learning& learning = {}) {
  const auto count = [&](auto&& is) { return std::count_if(series.begin(), series.end(), is); };
  table.cells(subject, block, rotated ? "deg" : "field", series.size(), count([](const AdaptationTrial& t) { return !t.perturbation; }),
              count([](const AdaptationTrial& t) { return t.response.has_value(); }));
  std::string remark;
  try {
    const AdaptationFit fit = fitAdaptation(series, kResamples, 1);
    table.cells(fit.count == StateCount::One ? "one" : fit.count == StateCount::Two ? "two" : "undecided");
    for (const LearningFit* of : {&fit.two, &fit.one}) {
      for (std::size_t k = 0; k < of->states.size(); ++k)
        table.cells(of->states[k].retention, of->intervals[k][0], of->states[k].learningRate, of->intervals[k][1]);
      table.cells(std::sqrt(of->meanSquare));
    }
  } catch (const RefusedError& error) {
    constexpr int kCells = 1 + 3 * 2 * 3 + 2;  // the count; three states, retention and rate with their intervals; two residuals
    for (int i = 0; i < kCells; ++i) table.cells("");
    remark = error.what();
  }
  table.cells(learning.plateau);
  for (const bool angles : {false, true})
    for (const double deviation : {learning.first, learning.last, learning.afterEffect})
      table.cells(angles == rotated ? deviation : kNotMeasured);
  table.row(remark);
}

void adaptationTable(const std::map<std::string, TaughtTrials>& people, Sheet& table) {
  for (const auto& [subject, person] : people) {
    AdaptationSeries all;
    std::map<int, AdaptationSeries> blocks;
    for (const AnalyzedTrial* trial : person.trials) {
      all.push_back(seen(*trial, person.rotated));
      blocks[trial->key.block].push_back(all.back());
    }
    for (const auto& [block, series] : blocks) row(table, subject, std::to_string(block), series, person.rotated);
    row(table, subject, kAllTogether, all, person.rotated, learningOf(person));
  }
}

}  // namespace

void writeAdaptationTable(const Analysis& analysis, const TableWriter& write) {
  const auto people = taughtTrials(analysis);
  if (!people.empty()) writeSheet(write, "adaptation.csv", people, adaptationTable);
}

}  // namespace reachlab::analysis
