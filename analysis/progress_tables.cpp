#include "analysis/sheet.h"

#include <cmath>

namespace reachlab::analysis {
namespace {

/// Successes, trials, their share and its interval [%].
void addShare(Sheet& table, std::size_t successes, std::size_t trials, const Bounds& interval) {
  table.row(successes, trials, 100.0 * static_cast<double>(successes) / static_cast<double>(trials),
            Bounds{100 * interval.low, 100 * interval.high});
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

void writeProgressTables(const Analysis& analysis, const TableWriter& write) {
  writeSheet(write, "success_table.csv", analysis, successRows);
  writeSheet(write, "learning.csv", analysis, learningTable);
  writeSheet(write, "effects.csv", analysis, effectsTable);
}

}  // namespace reachlab::analysis
