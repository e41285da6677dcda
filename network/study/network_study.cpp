#include "network/study/network_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/figure/figure.h"
#include "base/table_text.h"

namespace reachlab::network {
namespace {

constexpr std::array kObjects{StudyObject::Chain, StudyObject::Parallel};

StudyCell runCell(const StudyPlan& plan, StudyObject object, Coupling coupling, double roundTrip, const StudyReference& reference) {
  StudyCell cell{object, coupling, roundTrip, 0, plan.seeds, 0, 0, reference.rms, 0};
  std::vector<StudyOutcome> stable, all;
  for (int seed = 1; seed <= plan.seeds; ++seed) {
    StudySetup setup;
    setup.experiment = makeStudyExperiment(object);
    setup.roundTrip = roundTrip;
    setup.loss = plan.loss;
    setup.jitterShare = plan.jitterShare;
    setup.seed = static_cast<std::uint64_t>(seed);
    const StudyOutcome outcome = runTwoHands(setup, coupling, copySettingsFor(setup.experiment), reference);
    all.push_back(outcome);
    if (outcome.stable) stable.push_back(outcome);
    cell.given = std::max(cell.given, outcome.given);
  }
  cell.stable = static_cast<int>(stable.size());
  const std::vector<StudyOutcome>& counted = stable.empty() ? all : stable;
  for (const StudyOutcome& outcome : counted) {
    cell.apart += outcome.apart / static_cast<double>(counted.size());
    cell.forceError += outcome.forceError / static_cast<double>(counted.size());
  }
  return cell;
}

template <class Row>
const Row* find(const std::vector<Row>& rows, StudyObject object, Coupling coupling, double roundTrip) {
  for (const Row& row : rows)
    if (row.object == object && row.coupling == coupling && row.roundTrip == roundTrip) return &row;
  return nullptr;
}

template <class Row>
std::vector<double> roundTripsOf(const std::vector<Row>& rows) {
  std::vector<double> all;
  for (const Row& row : rows) all.push_back(row.roundTrip);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// A table of one object: couplings down, round trips across.
template <class Row, class Cell>
std::string formatObject(const std::vector<Row>& rows, StudyObject object, const std::string& title, Cell&& cell) {
  const std::vector<double> across = roundTripsOf(rows);
  std::string text = fmt::format("{:<46}", title);
  for (const double roundTrip : across) text += fmt::format(" {:>19}", fmt::format("{:.0f} ms", 1e3 * roundTrip));
  text += "\n";
  for (const Coupling coupling : kCouplings) {
    std::string line;
    for (const double roundTrip : across)
      if (const Row* row = find(rows, object, coupling, roundTrip)) line += fmt::format(" {:>19}", cell(*row));
    if (!line.empty()) text += fmt::format("{:<46}{}\n", describe(coupling), line);
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

figure::Series seriesOf(Coupling coupling, int number) {
  figure::Series series;
  series.label = std::string(describe(coupling));
  series.color = figure::palette::series(number);
  series.marker = figure::markerOf(number);
  if (coupling == Coupling::Design) series.width = figure::kThick;
  return series;
}

double percentStable(const StudyShare& share) { return 100.0 * share.stable / std::max(1, share.runs); }

}  // namespace

std::string_view nameOf(StudyObject object) { return object == StudyObject::Chain ? "chain" : "parallel"; }

StudyShare runRandomSetups(const StudyPlan& plan, StudyObject object, Coupling coupling, double roundTrip) {
  StudyShare share{object, coupling, roundTrip, 0, plan.setups, 0, 0};
  for (int i = 0; i < plan.setups; ++i) {
    StudySetup setup = makeRandomSetup(object, plan.seed, i);
    setup.roundTrip = roundTrip;
    setup.loss = plan.loss;
    setup.jitterShare = plan.jitterShare;
    const StudyOutcome outcome = runTwoHands(setup, coupling, copySettingsFor(setup.experiment), makeReference(setup));
    if (outcome.stable) ++share.stable;
    share.ledgerWorst = std::max(share.ledgerWorst, outcome.ledgerWorst);
    share.ledgerDuration = std::max(share.ledgerDuration, outcome.ledgerDuration);
  }
  return share;
}

StudyTables runNetworkStudy(const StudyPlan& plan, const StudyProgress& progress) {
  StudyTables tables;
  for (const StudyObject object : kObjects) {
    StudySetup alone;
    alone.experiment = makeStudyExperiment(object);
    const StudyReference reference = makeReference(alone);
    for (const Coupling coupling : plan.couplings) {
      if (progress) progress(fmt::format("{}: {}", nameOf(object), describe(coupling)));
      for (const double roundTrip : plan.roundTrips) tables.cells.push_back(runCell(plan, object, coupling, roundTrip, reference));
      if (plan.setups == 0) continue;
      for (const double roundTrip : plan.roundTrips)
        if (roundTrip > 0) tables.shares.push_back(runRandomSetups(plan, object, coupling, roundTrip));
    }
  }
  return tables;
}

std::string formatStudy(const StudyTables& tables) {
  std::string text;
  for (const StudyObject object : kObjects) {
    if (const auto any = std::find_if(tables.cells.begin(), tables.cells.end(), [&](const StudyCell& c) { return c.object == object; });
        any != tables.cells.end())
      text += formatObject(
                  tables.cells, object, fmt::format("{} ({:.2f} N): stable, mm, N", nameOf(object), any->force),
                  [](const StudyCell& c) { return fmt::format("{}/{} {:.2f} {:.2f}", c.stable, c.runs, 1e3 * c.apart, c.forceError); }) +
              "\n";
    if (!tables.shares.empty())
      text += formatObject(tables.shares, object, fmt::format("{}, random set-ups: stable, J, s above", nameOf(object)),
                           [](const StudyShare& s) {
                             const std::string share = fmt::format("{:.1f} %", percentStable(s));
                             return s.coupling == Coupling::Design ? fmt::format("{} {:.2f} {:.2f}", share, s.ledgerWorst, s.ledgerDuration)
                                                                   : share;
                           }) +
              "\n";
  }
  return text;
}

std::string studyCsv(const StudyTables& tables) {
  TableText table(',', "");
  table.row({"table", "object", "coupling", "round_trip_s", "runs", "stable", "apart_rms_m", "force_error_rms_n", "force_rms_n", "given_j",
             "ledger_excess_j", "ledger_excess_s"});
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const StudyCell& c : tables.cells) {
    table.cell("seeds").cell(nameOf(c.object)).cell(nameOf(c.coupling)).number(c.roundTrip).whole(c.runs).whole(c.stable);
    for (const double value : {c.apart, c.forceError, c.force, c.given, kNone, kNone}) table.number(value);
    table.endRow();
  }
  for (const StudyShare& s : tables.shares) {
    const bool copies = s.coupling == Coupling::Design;
    table.cell("random").cell(nameOf(s.object)).cell(nameOf(s.coupling)).number(s.roundTrip).whole(s.runs).whole(s.stable);
    for (const double value : {kNone, kNone, kNone, kNone, copies ? s.ledgerWorst : kNone, copies ? s.ledgerDuration : kNone})
      table.number(value);
    table.endRow();
  }
  return table.text();
}

// Each way of coupling where it was stable; a line ends where it is not any more. Below, where there are any, the random set-ups.
std::string drawStudy(const StudyTables& tables) {
  figure::Figure page;
  page.columns = 2;
  for (const StudyObject object : kObjects) {
    figure::Panel apart = panelOf(fmt::format("{}: copies apart", nameOf(object)), "RMS (mm)", figure::Scale::Log);
    figure::Panel force = panelOf(fmt::format("{}: force", nameOf(object)), "Error, RMS (N)", figure::Scale::Log);
    int number = 0;
    for (const Coupling coupling : kCouplings) {
      figure::Series line = seriesOf(coupling, number++);
      figure::Series error = line;
      for (const StudyCell& cell : tables.cells) {
        if (cell.object != object || cell.coupling != coupling) continue;
        const bool stable = cell.stable == cell.runs;
        const double none = std::numeric_limits<double>::quiet_NaN();
        line.x.push_back(1e3 * cell.roundTrip), line.y.push_back(stable ? 1e3 * cell.apart : none);
        error.x.push_back(1e3 * cell.roundTrip), error.y.push_back(stable ? cell.forceError : none);
      }
      if (line.x.empty()) continue;
      apart.series.push_back(line);
      force.series.push_back(error);
    }
    if (object == StudyObject::Parallel) force.legend = figure::LegendPlace::Below;
    page.panels.push_back(std::move(apart));
    page.panels.push_back(std::move(force));
  }
  if (tables.shares.empty()) return figure::renderSvg(page);
  for (const StudyObject object : kObjects) {
    figure::Panel share = panelOf(fmt::format("{}: random set-ups", nameOf(object)), "Stable (%)", figure::Scale::Linear);
    share.y.from = 0, share.y.to = 100;
    int number = 0;
    for (const Coupling coupling : kCouplings) {
      figure::Series line = seriesOf(coupling, number++);
      for (const StudyShare& s : tables.shares)
        if (s.object == object && s.coupling == coupling) line.x.push_back(1e3 * s.roundTrip), line.y.push_back(percentStable(s));
      if (!line.x.empty()) share.series.push_back(line);
    }
    page.panels.push_back(std::move(share));
  }
  return figure::renderSvg(page);
}

}  // namespace reachlab::network
