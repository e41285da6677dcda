#include "sim/predict/panel_effort.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/predict/condition.h"
#include "sim/predict/panel_profile.h"

namespace reachlab::predict {
namespace {

constexpr double kRounding = 1e-17;  // what is left out of Taylor series in double, of the state
constexpr double kRefined = 1e-15;   // error of the control that is wanted of the passes, of its own norm
constexpr double kSeries = 1e-14;    // and of the series that they go by
constexpr int kMaxPasses = 8;

PanelGrid makeGrid(double fastest, double duration) {
  PanelGrid grid;
  const double blocks = std::ceil(fastest * duration / (2 * kPanelRate * kPack));
  grid.panels = kPack * static_cast<int>(std::clamp(blocks, 1.0, 1.0 + kMaxGridPanels / kPack));
  grid.halfWidth = duration / (2 * grid.panels);
  grid.rate = fastest * grid.halfWidth;
  return grid;
}

}  // namespace

std::optional<PanelEffort> PanelEffort::make(LineSystem<double> system, double duration) {
  const PanelGrid grid = makeGrid(SparseRows<double>(system, system.size, false).norm(), duration);
  if (!(grid.panels <= kMaxGridPanels)) return std::nullopt;
  return PanelEffort(std::move(system), grid);
}

PanelEffort::PanelEffort(LineSystem<double> system, const PanelGrid& grid)
    : system_(std::move(system)), grid_(grid), room_(std::make_unique_for_overwrite<std::byte[]>(bytes())),
      memory_(std::make_unique<std::pmr::monotonic_buffer_resource>(room_.get(), bytes())), series_(system_, grid, kRounding, *memory_),
      factor_(system_, grid, series_) {}

size_t PanelEffort::bytes() const {
  return PanelSeries<double>::bytesFor(grid_, system_.size, kRounding) +
         PanelSeries<DoubleDouble>::bytesFor(grid_, system_.size, kSeries / kRefuseCondition);
}

LeastEffort PanelEffort::solve() const {
  const int m = system_.controlled;
  const PanelFactor::Solution solution = factor_.solve(Eigen::Map<const Eigen::VectorXd>(system_.target.data(), m));
  std::vector<double> l(static_cast<size_t>(system_.size), 0.0);
  std::copy_n(solution.l.data(), m, l.begin());
  return follow(series_.makeControl(l), solution.size * solution.size);
}

std::optional<LeastEffort> PanelEffort::refine(const LineSystem<DoubleDouble>& system) const {
  const int m = system.controlled;
  const PanelSeries<DoubleDouble> series(system, grid_, kSeries / condition(), *memory_);
  std::vector<DoubleDouble> l(static_cast<size_t>(system.size), 0.0), missed = system.target;
  double first = 0, shrinks = 8 * std::numeric_limits<double>::epsilon() * condition();
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    Eigen::VectorXd right(m);
    for (int i = 0; i < m; ++i) right[i] = static_cast<double>(missed[i]);
    const PanelFactor::Solution correction = factor_.solve(right);
    if (!std::isfinite(correction.size)) return std::nullopt;
    for (int i = 0; i < m; ++i) l[i] += correction.l[i];
    const std::vector<Pack> control = series.makeControl(l);
    if (pass == 0) first = correction.size;
    if (pass == 1) shrinks = std::max(shrinks, correction.size / first);
    if (pass > 0 && correction.size * shrinks < kRefined * first) {
      DoubleDouble cost = 0.0;
      for (int i = 0; i < m; ++i) cost += l[i] * system.target[i];
      return follow(control, static_cast<double>(cost));
    }
    const std::vector<DoubleDouble> reached = series.integrate(control);
    for (int i = 0; i < m; ++i) missed[i] = system.target[i] - reached[i];
  }
  return std::nullopt;
}

LeastEffort PanelEffort::follow(const std::vector<Pack>& control, double cost) const {
  LeastEffort effort = followControl(system_, grid_, series_.step(), series_.terms(), control);
  effort.cost = cost;
  effort.condition = condition();
  return effort;
}

}  // namespace reachlab::predict
