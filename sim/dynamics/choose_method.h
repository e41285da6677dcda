#pragma once
#include "sim/dynamics/method_choice.h"
#include "sim/dynamics/object/object_model.h"

namespace reachlab::dynamics {

/// What the choice of a method looks at.
struct SceneFacts {
  bool linear = false;
  bool elasticEnds = false;  // a straight line whose ends throw the masses back
  bool hardCurve = false;    // |r_phi| falls far below its largest somewhere
  double step = 0.001;       // [s]
  double length = 0.2;       // [m] of a reach
  double duration = 1.35;    // [s]
};

/// Fills method, reason, fastestMode, predictedError and warnings for `asked` (auto or a method's name). Throws RefusedError with
/// the numbers and a remedy when the method asked for is unstable, or cannot do the scene.
MethodChoice chooseMethod(const std::string& asked, const ObjectModel& model, const SceneFacts& facts);

}  // namespace reachlab::dynamics
