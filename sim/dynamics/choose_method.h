#pragma once
#include "sim/dynamics/method_choice.h"
#include "sim/dynamics/object/object_model.h"

namespace reachlab::dynamics {

/// Properties of a scene on which the choice of a method depends.
struct SceneFacts {
  bool linear = false;
  bool elasticEnds = false;  // a straight line whose ends throw the masses back
  bool hardCurve = false;    // |r_phi| falls far below its largest somewhere
  double step = 0.001;       // [s]
  double length = 0.2;       // [m] of a reach
  double duration = 1.35;    // [s]
};

/// Fills method, reason, fastestMode, predictedError and warnings for `asked` (auto or the name of a method). Throws RefusedError with the
/// numbers and a remedy when the requested method is unstable or cannot compute the scene.
MethodChoice chooseMethod(const std::string& asked, const ObjectModel& model, const SceneFacts& facts);

}  // namespace reachlab::dynamics
