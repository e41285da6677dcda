#include "network/link_check/link_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/figure/figure.h"
#include "base/table_text.h"

namespace reachlab::network {
namespace {

TwoHandsOutcome runOver(const LinkBenchPlan& plan, double roundTrip, TwoHandsSetup setup, const TwoHandsReference& reference) {
  setup.roundTrip = roundTrip;
  setup.loss = plan.loss;
  setup.jitterShare = plan.jitterShare;
  return runTwoHands(setup, copySettingsFor(setup.experiment), reference);
}

LinkBenchRow runCell(const LinkBenchPlan& plan, SharedObject object, double roundTrip, const TwoHandsReference& reference) {
  LinkBenchRow cell{object, roundTrip, 0, plan.seeds, 0, 0, reference.rms, 0};
  std::vector<TwoHandsOutcome> stable, all;
  for (int seed = 1; seed <= plan.seeds; ++seed) {
    TwoHandsSetup setup;
    setup.experiment = makeSharedExperiment(object);
    setup.seed = static_cast<std::uint64_t>(seed);
    const TwoHandsOutcome outcome = runOver(plan, roundTrip, setup, reference);
    all.push_back(outcome);
    if (outcome.stable) stable.push_back(outcome);
    cell.given = std::max(cell.given, outcome.given);
  }
  cell.stable = static_cast<int>(stable.size());
  const std::vector<TwoHandsOutcome>& counted = stable.empty() ? all : stable;
  for (const TwoHandsOutcome& outcome : counted) {
    cell.apart += outcome.apart / static_cast<double>(counted.size());
    cell.forceError += outcome.forceError / static_cast<double>(counted.size());
  }
  return cell;
}

double percentStable(const LinkBenchRow& row) { return 100.0 * row.stable / std::max(1, row.runs); }

using Rows = std::vector<LinkBenchRow>;
using Text = std::function<std::string(const LinkBenchRow&)>;

// Objects down, round trips across.
std::string formatRows(const Rows& rows, const Text& title, const Text& cell) {
  std::set<double> across;
  for (const LinkBenchRow& row : rows) across.insert(row.roundTrip);
  std::string text;
  for (const SharedObject object : kSharedObjects) {
    std::string head, line;
    for (const double roundTrip : across)
      for (const LinkBenchRow& row : rows) {
        if (row.object != object || row.roundTrip != roundTrip) continue;
        if (line.empty()) line = fmt::format("{:<46}", title(row));
        head += fmt::format(" {:>19}", fmt::format("{:.0f} ms", 1e3 * roundTrip));
        line += fmt::format(" {:>19}", cell(row));
      }
    if (!line.empty()) text += fmt::format("{:<46}{}\n{}\n", "", head, line);
  }
  return text;
}

// A panel with one line against the round trip; it has a gap where `valueOf` is not a number.
figure::Panel panelOf(SharedObject object, const std::string& title, const std::string& y, const Rows& rows,
                      const std::function<double(const LinkBenchRow&)>& valueOf) {
  figure::Panel panel;
  panel.title = fmt::format("{}: {}", nameOf(object), title);
  panel.x.label = "Round trip (ms)";
  panel.y.label = y;
  panel.y.scale = figure::Scale::Log;
  panel.legend = figure::LegendPlace::None;
  figure::Series& series = panel.series.emplace_back();
  series.color = figure::palette::series(0);
  series.marker = figure::markerOf(0);
  for (const LinkBenchRow& row : rows)
    if (row.object == object) series.x.push_back(1e3 * row.roundTrip), series.y.push_back(valueOf(row));
  return panel;
}

}  // namespace

LinkBenchRow runRandomSetups(const LinkBenchPlan& plan, SharedObject object, double roundTrip) {
  LinkBenchRow share{.object = object, .roundTrip = roundTrip, .runs = plan.setups, .ledgerWorst = 0, .ledgerDuration = 0};
  for (int i = 0; i < plan.setups; ++i) {
    const TwoHandsSetup setup = makeRandomSetup(object, plan.seed, i);
    const TwoHandsOutcome outcome = runOver(plan, roundTrip, setup, makeReference(setup));
    if (outcome.stable) ++share.stable;
    share.ledgerWorst = std::max(share.ledgerWorst, outcome.ledgerWorst);
    share.ledgerDuration = std::max(share.ledgerDuration, outcome.ledgerDuration);
  }
  return share;
}

LinkBenchTables runLinkBench(const LinkBenchPlan& plan, const LinkBenchProgress& progress) {
  LinkBenchTables tables;
  for (const SharedObject object : kSharedObjects) {
    TwoHandsSetup alone;
    alone.experiment = makeSharedExperiment(object);
    const TwoHandsReference reference = makeReference(alone);
    for (const double roundTrip : plan.roundTrips) {
      if (progress) progress(fmt::format("{}: round trip {:.0f} ms", nameOf(object), 1e3 * roundTrip));
      tables.cells.push_back(runCell(plan, object, roundTrip, reference));
      if (plan.setups > 0 && roundTrip > 0) tables.shares.push_back(runRandomSetups(plan, object, roundTrip));
    }
  }
  return tables;
}

std::string formatLinkBench(const LinkBenchTables& tables) {
  return formatRows(
             tables.cells, [](const auto& c) { return fmt::format("{} ({:.2f} N): stable, mm, N", nameOf(c.object), c.force); },
             [](const auto& c) { return fmt::format("{}/{} {:.2f} {:.2f}", c.stable, c.runs, 1e3 * c.apart, c.forceError); }) +
         formatRows(
             tables.shares, [](const auto& s) { return fmt::format("{}, random set-ups: stable, J, s above", nameOf(s.object)); },
             [](const auto& s) { return fmt::format("{:.1f} % {:.2f} {:.2f}", percentStable(s), s.ledgerWorst, s.ledgerDuration); });
}

std::string linkBenchCsv(const LinkBenchTables& tables) {
  TableText table(',', "");
  table.row({"table", "object", "coupling", "round_trip_s", "runs", "stable", "apart_rms_m", "force_error_rms_n", "force_rms_n", "given_j",
             "ledger_excess_j", "ledger_excess_s"});
  const auto add = [&](std::string_view name, const Rows& rows) {
    for (const LinkBenchRow& row : rows) {
      table.cell(name).cell(nameOf(row.object)).cell("design").number(row.roundTrip).whole(row.runs).whole(row.stable);
      for (const double value : {row.apart, row.forceError, row.force, row.given, row.ledgerWorst, row.ledgerDuration}) table.number(value);
      table.endRow();
    }
  };
  add("seeds", tables.cells);
  add("random", tables.shares);
  return table.text();
}

// The lines end where a run was not stable any more. Below, where there are any, the random set-ups.
std::string drawLinkBench(const LinkBenchTables& tables) {
  figure::Figure page;
  page.columns = 2;
  const auto whileStable = [](double LinkBenchRow::*value, double scale) {
    return [=](const LinkBenchRow& c) { return c.stable == c.runs ? scale * c.*value : LinkBenchRow::kNone; };
  };
  for (const SharedObject object : kSharedObjects) {
    page.panels.push_back(panelOf(object, "copies apart", "RMS (mm)", tables.cells, whileStable(&LinkBenchRow::apart, 1e3)));
    page.panels.push_back(panelOf(object, "force", "Error, RMS (N)", tables.cells, whileStable(&LinkBenchRow::forceError, 1)));
  }
  if (tables.shares.empty()) return figure::renderSvg(page);
  for (const SharedObject object : kSharedObjects) {
    figure::Panel& share = page.panels.emplace_back(panelOf(object, "random set-ups", "Stable (%)", tables.shares, percentStable));
    share.y.scale = figure::Scale::Linear;
    share.y.from = 0, share.y.to = 100;
  }
  return figure::renderSvg(page);
}

}  // namespace reachlab::network
