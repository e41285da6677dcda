#include "analysis/sheet.h"

#include <cmath>

namespace reachlab::analysis {
namespace {

void successTableText(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "success_table.csv");
  for (const SuccessCell& cell : analysis.success) {
    table.cell(cell.subject).whole(cell.day).cell(analysis.conditions[cell.condition].name);
    table.count(cell.successes);
    table.count(cell.trials).number(100.0 * static_cast<double>(cell.successes) / static_cast<double>(cell.trials));
    table.bounds(Bounds{100 * cell.interval.low, 100 * cell.interval.high});
    table.endRow();
  }
  table.flush();
}

void learningTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "learning.csv");
  for (const LearningPoint& p : analysis.learning) {
    table.cell(p.subject).cell(p.session).cell(analysis.conditions[p.condition].name).whole(p.firstTrial).whole(p.lastTrial);
    table.count(p.successes);
    table.count(p.trials).number(100.0 * static_cast<double>(p.successes) / static_cast<double>(p.trials));
    table.bounds(Bounds{100 * p.interval.low, 100 * p.interval.high});
    table.endRow();
  }
  table.flush();
}

void effectsTable(const Analysis& analysis, const TableWriter& write) {
  Sheet table(write, "effects.csv");
  for (const Effect& e : analysis.effects) {
    const auto place = [&](int i) { return e.ofDay ? "D" + std::to_string(i) : analysis.conditions[static_cast<std::size_t>(i)].name; };
    table.cell(e.ofDay ? "day" : "condition")
        .cell(e.ofDay ? analysis.conditions[e.condition].name : "")
        .cell(place(e.from))
        .cell(place(e.to));
    table.count(e.people).number(e.points.mean).bounds(e.pointsInterval);
    const Bounds logits = e.logitInterval;
    table.number(std::exp(e.logit.mean)).bounds(logits.finite() ? Bounds{std::exp(logits.low), std::exp(logits.high)} : logits);
    table.number(e.people > 1 ? e.p : kNotMeasured);
    table.endRow();
  }
  for (const LearningSlope& s : analysis.slopes) {
    table.cell("slope").cell(analysis.conditions[s.condition].name).cell("").cell("");
    table.count(s.people).number(s.perHundred).bounds(s.interval).number(kNotMeasured).bounds(std::nullopt);
    table.number(s.people > 1 ? s.p : kNotMeasured);
    table.endRow();
  }
  table.flush();
}

}  // namespace

void writeProgressTables(const Analysis& analysis, const TableWriter& write) {
  successTableText(analysis, write);
  learningTable(analysis, write);
  effectsTable(analysis, write);
}

}  // namespace reachlab::analysis
