#pragma once
#include <optional>
#include <vector>

#include "constraints/geometry/curve_way.h"
#include "sim/dynamics/object/mass_state.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::subjects {

/// The path of a task from start to target in metres: along the chord of a straight line and in free space, along the arc of a curve. A
/// value that any thread may use. Its members neither allocate nor throw.
class ReachWay {
 public:
  /// Throws FaultError (start and target are at one position) or RefusedError (a surface has no single path).
  explicit ReachWay(const experiment::CompiledExperiment& experiment);

  double length() const noexcept { return length_; }
  struct Place {
    Vec3 position, along;  // [m], unit
  };
  /// The point at `s` [m] from the start.
  Place at(double s) const noexcept;
  /// The distance [m] of a mass from the start.
  double placeOf(const dynamics::MassState& mass) const noexcept;

 private:
  std::optional<constraints::CurveWay> curve_;  // nullopt: straight
  Vec3 start_, direction_;
  double length_ = 0;
  std::vector<double> parameters_;  // at equal steps of the arc length
};

}  // namespace reachlab::subjects
