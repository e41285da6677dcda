#include "bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/figure/figure.h"
#include "bench/suite.h"

namespace reachlab::bench {
namespace {

/// The scenes or the methods, in the order of the rows.
std::vector<std::string> eachOf(const std::vector<Row>& rows, std::string Row::*name) {
  std::vector<std::string> names;
  for (const Row& row : rows)
    if (std::find(names.begin(), names.end(), row.*name) == names.end()) names.push_back(row.*name);
  return names;
}

std::string setting(const Row& row) {
  if (row.tolerance > 0) return fmt::format("tol {:.0e}", row.tolerance);
  return fmt::format("{:g} ms", row.step * 1e3);
}

std::string side(const Row* row) { return row ? fmt::format("{} ({}) {:.1f}", row->method, setting(*row), row->nsPerMs) : "none"; }

/// A method's rows by price, without those that another setting of it beats in both price and error, and without errors beyond any
/// motion.
std::vector<const Row*> worthwhile(const std::vector<Row>& rows, const std::string& scene, const std::string& method) {
  constexpr double kNoMotion = 1;
  std::vector<const Row*> own, kept;
  for (const Row& row : rows)
    if (row.scene == scene && row.method == method && row.failure.empty() && row.error.state < kNoMotion) own.push_back(&row);
  std::sort(own.begin(), own.end(), [](const Row* a, const Row* b) { return a->nsPerMs < b->nsPerMs; });
  for (const Row* row : own)
    if (kept.empty() || row->error.state < kept.back()->error.state) kept.push_back(row);
  return kept;
}

}  // namespace

const Row* cheapest(const std::vector<Row>& rows, const std::string& scene, double error, const std::function<bool(const Row&)>& wanted) {
  const Row* best = nullptr;
  for (const Row& row : rows)
    if (row.scene == scene && wanted(row) && row.error.state <= error && (!best || row.nsPerMs < best->nsPerMs)) best = &row;
  return best;
}

std::string formatTable(const std::vector<Row>& rows) {
  std::string out = fmt::format("{:<7} {:<18} {:<10} {:>9} {:>11} {:>9} {:>19} {:>7} {:>8} {:>6}  {}\n", "scene", "method", "setting",
                                "state", "position_m", "ns_per_ms", "quartiles", "steps", "rhs", "worst", "form");
  for (const Row& row : rows) {
    const std::string head = fmt::format("{:<7} {:<18} {:<10} ", row.scene, row.method, setting(row));
    if (!row.failure.empty()) {
      out += head + "failed: " + row.failure + "\n";
      continue;
    }
    out +=
        head + fmt::format("{:>9.1e} {:>11.1e} {:>9.1f} {:>19} {:>7} {:>8} {:>6}  {}\n", row.error.state, row.error.position, row.nsPerMs,
                           fmt::format("{:.1f} - {:.1f}", row.nsLow, row.nsHigh), row.steps, row.rhsEvaluations, row.worstTick, row.form);
  }
  return out;
}

std::string formatRatios(const std::vector<Row>& rows) {
  std::string out;
  for (const std::string& scene : eachOf(rows, &Row::scene))
    for (double error : {1e-6, 1e-10}) {
      const Row* own = cheapest(rows, scene, error, [](const Row& r) { return !isPeer(r); });
      const Row* automatic = cheapest(rows, scene, error, [](const Row& r) { return r.method == "auto"; });
      const Row* peer = cheapest(rows, scene, error, isPeer);
      std::string ratio = "-";
      const Row* ours = automatic ? automatic : own;
      if (ours && peer) ratio = fmt::format("{:.2f}", peer->nsPerMs / ours->nsPerMs);
      out += fmt::format("{:<7} state {:.0e}: ratio {:>6}   ours {:<32} peer {}\n", scene, error, ratio, side(ours), side(peer));
    }
  return out;
}

std::string drawWorkPrecision(const std::vector<Row>& rows) {
  figure::Figure figure{.columns = 4, .panelWidth = 62, .panelHeight = 48};
  std::vector<std::string> methods = eachOf(rows, &Row::method);  // the same colour in every panel
  const auto automatic = std::find(methods.begin(), methods.end(), "auto");
  if (automatic != methods.end()) std::rotate(automatic, automatic + 1, methods.end());  // drawn last: it lies on the method it chose
  for (const std::string& scene : eachOf(rows, &Row::scene)) {
    figure::Panel panel{.title = scene,
                        .x = {.label = "Processor time (ns per simulated ms)", .scale = figure::Scale::Log},
                        .y = {.label = "Largest state error (SI)", .scale = figure::Scale::Log},
                        .legend = figure.panels.empty() ? figure::LegendPlace::Auto : figure::LegendPlace::None};
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const std::vector<const Row*> own = worthwhile(rows, scene, methods[i]);
      if (own.empty() && !figure.panels.empty()) continue;
      figure::Series series{
          .label = methods[i], .color = figure::palette::series(static_cast<int>(i)), .marker = figure::markerOf(static_cast<int>(i))};
      if (methods[i] == "auto") series.markerSize *= 1.8;
      if (!own.empty() && isPeer(*own.front())) series.dash = figure::Dash::Dashed;
      for (const Row* row : own) {
        series.x.push_back(row->nsPerMs);
        series.y.push_back(std::max(row->error.state, 1e-16));  // exact to rounding is drawn at the bottom
      }
      panel.series.push_back(std::move(series));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure::renderSvg(figure);
}

}  // namespace reachlab::bench
