#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/adaptation/state_space.h"
#include "analysis/sheet.h"
#include "analysis/taught_trials.h"
#include "base/error.h"

namespace reachlab::analysis {
namespace {

constexpr int kResamples = 200;  // of the intervals

// A clamped cursor shows no error that the hand made. A trial that is left out was felt, and its response does not count.
AdaptationTrial seen(const AnalyzedTrial& trial, const TaughtTrials& person) {
  const auto known = [&](double value) { return std::isfinite(value) && !trial.isLeftOut() ? std::optional(value) : std::nullopt; };
  if (person.rotated) return {trial.scene.clamp ? std::nullopt : std::optional(trial.scene.rotation), known(-trial.measures.handAngle)};
  if (trial.scene.channel) return {std::nullopt, known(trial.measures.adaptation / 100 * person.unitOf(trial))};
  return {person.strengthIn(trial), std::nullopt};
}

void row(Sheet& table, const TaughtTrials& person, const std::string& session, const std::string& block,
         const std::vector<const AnalyzedTrial*>& trials, const Learning& learning = {}) {
  const bool rotated = person.rotated;
  AdaptationSeries series;
  for (const AnalyzedTrial* trial : trials) series.push_back(seen(*trial, person));
  const auto count = [&](auto&& is) { return std::count_if(series.begin(), series.end(), is); };
  table.cells(person.subject, session, block, rotated ? "deg" : "field", series.size(),
              count([](const AdaptationTrial& t) { return !t.perturbation; }),
              count([](const AdaptationTrial& t) { return t.response.has_value(); }));
  std::string remark;
  try {
    if (std::any_of(trials.begin(), trials.end(), [](const AnalyzedTrial* t) { return t->scene.clamp.value_or(0) != 0; }))
      throw RefusedError("the cursor is clamped at an angle, and the model has no error that is the same whatever the hand does");
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

void adaptationTable(const std::vector<TaughtTrials>& people, Sheet& table) {
  for (const TaughtTrials& person : people) {
    struct Block {
      TrialKey key;
      std::vector<const AnalyzedTrial*> trials;
    };
    std::vector<Block> blocks;  // in the order in which they were done
    for (const AnalyzedTrial* trial : person.trials) {
      const TrialKey& key = trial->key;
      if (blocks.empty() || blocks.back().key.session != key.session || blocks.back().key.block != key.block) blocks.push_back({key, {}});
      blocks.back().trials.push_back(trial);
    }
    for (const Block& block : blocks) row(table, person, block.key.session, std::to_string(block.key.block), block.trials);
    row(table, person, kAllTogether, kAllTogether, person.trials, learningOf(person));
  }
}

}  // namespace

void writeAdaptationTable(const Analysis& analysis, const TableWriter& write) {
  const auto people = taughtTrials(analysis);
  if (!people.empty()) writeSheet(write, "adaptation.csv", people, adaptationTable);
}

}  // namespace reachlab::analysis
