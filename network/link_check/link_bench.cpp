#include "network/link_check/link_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "analysis/figure/figure.h"
#include "base/table_text.h"

namespace reachlab::network {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

LinkBenchCell runCell(const LinkBenchPlan& plan, SharedObject object, double roundTrip, const TwoHandsReference& reference) {
  LinkBenchCell cell{object, roundTrip, 0, plan.seeds, 0, 0, reference.rms, 0};
  std::vector<TwoHandsOutcome> stable, all;
  for (int seed = 1; seed <= plan.seeds; ++seed) {
    TwoHandsSetup setup;
    setup.experiment = makeSharedExperiment(object);
    setup.roundTrip = roundTrip;
    setup.loss = plan.loss;
    setup.jitterShare = plan.jitterShare;
    setup.seed = static_cast<std::uint64_t>(seed);
    const TwoHandsOutcome outcome = runTwoHands(setup, copySettingsFor(setup.experiment), reference);
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

double percentStable(const LinkBenchShare& share) { return 100.0 * share.stable / std::max(1, share.runs); }

// Objects down, round trips across.
template <class Row, class Title, class Cell>
std::string formatRows(const std::vector<Row>& rows, Title&& title, Cell&& cell) {
  std::set<double> across;
  for (const Row& row : rows) across.insert(row.roundTrip);
  std::string text;
  for (const SharedObject object : kSharedObjects) {
    std::string head, line;
    for (const double roundTrip : across)
      for (const Row& row : rows) {
        if (row.object != object || row.roundTrip != roundTrip) continue;
        if (line.empty()) line = fmt::format("{:<46}", title(row));
        head += fmt::format(" {:>19}", fmt::format("{:.0f} ms", 1e3 * roundTrip));
        line += fmt::format(" {:>19}", cell(row));
      }
    if (!line.empty()) text += fmt::format("{:<46}{}\n{}\n", "", head, line);
  }
  return text;
}

figure::Panel panelOf(const std::string& title, const std::string& y, figure::Scale scale) {
  figure::Panel panel;
  panel.title = title;
  panel.x.label = "Round trip (ms)";
  panel.y.label = y;
  panel.y.scale = scale;
  panel.legend = figure::LegendPlace::None;
  return panel;
}

// One line against the round trip; it has a gap where `valueOf` is not a number.
template <class Row, class Value>
figure::Series seriesOf(const std::vector<Row>& rows, SharedObject object, Value&& valueOf) {
  figure::Series series;
  series.color = figure::palette::series(0);
  series.marker = figure::markerOf(0);
  for (const Row& row : rows)
    if (row.object == object) series.x.push_back(1e3 * row.roundTrip), series.y.push_back(valueOf(row));
  return series;
}

}  // namespace

LinkBenchShare runRandomSetups(const LinkBenchPlan& plan, SharedObject object, double roundTrip) {
  LinkBenchShare share{object, roundTrip, 0, plan.setups, 0, 0};
  for (int i = 0; i < plan.setups; ++i) {
    TwoHandsSetup setup = makeRandomSetup(object, plan.seed, i);
    setup.roundTrip = roundTrip;
    setup.loss = plan.loss;
    setup.jitterShare = plan.jitterShare;
    const TwoHandsOutcome outcome = runTwoHands(setup, copySettingsFor(setup.experiment), makeReference(setup));
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
             tables.cells, [](const LinkBenchCell& c) { return fmt::format("{} ({:.2f} N): stable, mm, N", nameOf(c.object), c.force); },
             [](const LinkBenchCell& c) { return fmt::format("{}/{} {:.2f} {:.2f}", c.stable, c.runs, 1e3 * c.apart, c.forceError); }) +
         formatRows(
             tables.shares, [](const LinkBenchShare& s) { return fmt::format("{}, random set-ups: stable, J, s above", nameOf(s.object)); },
             [](const LinkBenchShare& s) {
               return fmt::format("{:.1f} % {:.2f} {:.2f}", percentStable(s), s.ledgerWorst, s.ledgerDuration);
             });
}

std::string linkBenchCsv(const LinkBenchTables& tables) {
  TableText table(',', "");
  table.row({"table", "object", "coupling", "round_trip_s", "runs", "stable", "apart_rms_m", "force_error_rms_n", "force_rms_n", "given_j",
             "ledger_excess_j", "ledger_excess_s"});
  const auto add = [&](std::string_view name, const auto& row, std::initializer_list<double> values) {
    table.cell(name).cell(nameOf(row.object)).cell("design").number(row.roundTrip).whole(row.runs).whole(row.stable);
    for (const double value : values) table.number(value);
    table.endRow();
  };
  for (const LinkBenchCell& c : tables.cells) add("seeds", c, {c.apart, c.forceError, c.force, c.given, kNone, kNone});
  for (const LinkBenchShare& s : tables.shares) add("random", s, {kNone, kNone, kNone, kNone, s.ledgerWorst, s.ledgerDuration});
  return table.text();
}

// The lines end where a run was not stable any more. Below, where there are any, the random set-ups.
std::string drawLinkBench(const LinkBenchTables& tables) {
  figure::Figure page;
  page.columns = 2;
  for (const SharedObject object : kSharedObjects) {
    figure::Panel apart = panelOf(fmt::format("{}: copies apart", nameOf(object)), "RMS (mm)", figure::Scale::Log);
    figure::Panel force = panelOf(fmt::format("{}: force", nameOf(object)), "Error, RMS (N)", figure::Scale::Log);
    apart.series = {seriesOf(tables.cells, object, [](const LinkBenchCell& c) { return c.stable == c.runs ? 1e3 * c.apart : kNone; })};
    force.series = {seriesOf(tables.cells, object, [](const LinkBenchCell& c) { return c.stable == c.runs ? c.forceError : kNone; })};
    page.panels.push_back(std::move(apart));
    page.panels.push_back(std::move(force));
  }
  if (tables.shares.empty()) return figure::renderSvg(page);
  for (const SharedObject object : kSharedObjects) {
    figure::Panel share = panelOf(fmt::format("{}: random set-ups", nameOf(object)), "Stable (%)", figure::Scale::Linear);
    share.y.from = 0, share.y.to = 100;
    share.series = {seriesOf(tables.shares, object, percentStable)};
    page.panels.push_back(std::move(share));
  }
  return figure::renderSvg(page);
}

}  // namespace reachlab::network
