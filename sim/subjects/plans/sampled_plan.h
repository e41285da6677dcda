#pragma once
#include <vector>

#include "base/math/vec3.h"
#include "sim/subjects/plans/reach_plan.h"

namespace reachlab::subjects {

/// A plan on a grid of a tick or less, for hands that read it a thousand times per trial. Polynomials run through six positions. Halfway
/// between two positions they lie within kWithin of the plan. A plan that such polynomials do not meet (a kink, a pole) is evaluated
/// directly. A value that any thread may use.
class SampledPlan {
 public:
  static constexpr double kWithin = 2e-12;  // [m]

  explicit SampledPlan(ReachPlan plan);
  double duration() const noexcept { return plan_.duration; }
  /// The intended position of the hand. 0 <= time <= duration.
  Vec3 at(double time) const { return places_.empty() ? plan_.handAt(time) : interpolate(time); }

 private:
  Vec3 interpolate(double time) const noexcept;

  ReachPlan plan_;
  double step_ = 0;             // [s]
  std::vector<double> places_;  // [m] x, y, z and a 0 for each; empty: the plan is not smooth enough
};

}  // namespace reachlab::subjects
