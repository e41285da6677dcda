#pragma once
#include <vector>

#include "base/math/vec3.h"
#include "devices/simulated/reach_plan.h"

namespace reachlab::devices {

/// A plan on a grid of a tick or less, for hands that ask it a thousand times a trial: polynomials through six places, within kWithin of the
/// plan halfway between every two of them. A plan that such polynomials do not meet (a kink, a pole) is asked itself. A value; any thread.
class SampledPlan {
 public:
  static constexpr double kWithin = 2e-12;  // [m]

  explicit SampledPlan(ReachPlan plan);
  double duration() const noexcept { return plan_.duration; }
  /// Where the hand is meant to be; 0 <= time <= duration.
  Vec3 at(double time) const { return places_.empty() ? plan_.handAt(time) : interpolate(time); }

 private:
  Vec3 interpolate(double time) const noexcept;

  ReachPlan plan_;
  double step_ = 0;           // [s]
  std::vector<Vec3> places_;  // empty: not smooth enough
};

}  // namespace reachlab::devices
