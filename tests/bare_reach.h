#pragma once
#include "sim/experiment/experiment.h"

namespace reachlab::experiment {

/// A free reach of a bare hand: 10 cm forward in 0.5 s.
inline Experiment bareReach() {
  Experiment e;
  e.constraint.name = "free";
  e.object.kind = ObjectKind::None;
  e.task.emplace();
  e.task->start = {0, 0, 0};
  e.task->target = {0, 0, -0.1};
  e.task->duration = 0.5;
  return e;
}

/// A curl field of `b` [N s/m] in the horizontal plane.
inline ViscousForce curl(double b) { return {{{{0, 0, b}, {0, 0, 0}, {-b, 0, 0}}}}; }

}  // namespace reachlab::experiment
