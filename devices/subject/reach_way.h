#pragma once
#include <optional>
#include <vector>

#include "constraints/geometry/curve_way.h"
#include "sim/dynamics/object/mass_state.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::devices {

/// The way of a task from start to target as metres: along the chord of a straight line and in free space, along the arc of a curve. A value; any thread; asking neither allocates nor throws.
class ReachWay {
 public:
  /// Throws FaultError (start and target are one place), RefusedError (a surface has no one way).
  explicit ReachWay(const experiment::CompiledExperiment& experiment);

  double length() const noexcept { return length_; }
  struct Place {
    Vec3 position, along;  // [m], unit
  };
  /// `s` [m] from the start.
  Place at(double s) const noexcept;
  /// How far from the start a mass is [m].
  double placeOf(const dynamics::MassState& mass) const noexcept;

 private:
  std::optional<constraints::CurveWay> curve_;  // none: straight
  Vec3 start_, direction_;
  double length_ = 0;
  std::vector<double> parameters_;  // at equal steps of the arc length
};

}  // namespace reachlab::devices
