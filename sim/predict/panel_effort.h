#pragma once
#include <cstddef>
#include <memory>
#include <memory_resource>
#include <optional>

#include "sim/predict/least_effort.h"
#include "sim/predict/panel_factor.h"

namespace reachlab::predict {

/// The problem of solveLeastEffort() for objects that need no more than kMaxGridPanels panels, much faster: W is factorised once,
/// in double, and l = W^-1 x_T then corrected by what the movement misses the target by, computed in DoubleDouble. This is
/// iterative refinement by the semi-normal equations (Bjorck 1987): the error shrinks by about eps times the condition with each
/// pass.
class PanelEffort {
 public:
  /// nullopt when the object's fastest rate needs more panels.
  static std::optional<PanelEffort> make(LineSystem<double> system, double duration);

  double condition() const { return factor_.condition(); }
  /// In double throughout: good while the condition is small.
  LeastEffort solve() const;
  /// `system` is the same with all its digits. nullopt when the passes do not converge.
  std::optional<LeastEffort> refine(const LineSystem<DoubleDouble>& system) const;

 private:
  PanelEffort(LineSystem<double> system, const PanelGrid& grid);
  size_t bytes() const;
  LeastEffort follow(const std::vector<Pack>& control, double cost) const;

  LineSystem<double> system_;
  PanelGrid grid_;
  // One piece for all series: many large ones would go back to the system, and be asked for again, with every prediction.
  std::unique_ptr<std::byte[]> room_;
  std::unique_ptr<std::pmr::monotonic_buffer_resource> memory_;
  PanelSeries<double> series_;
  PanelFactor factor_;
};
inline constexpr int kMaxGridPanels = 512;

}  // namespace reachlab::predict
