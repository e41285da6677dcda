#pragma once
#include <string>
#include <vector>

#include "constraints/constraint.h"
#include "sim/dynamics/hand/hand_function.h"
#include "sim/experiment/experiment_fwd.h"

namespace reachlab::cli {

/// The hand of `reach simulate`: hold, min-jerk, min-jerk-along, or the name of a CSV file with time_s, x_m, y_m, z_m. `breaks`: times at
/// which the hand's law is not smooth. A step should end there. Throws RefusedError (no task, zero chord) or FaultError (bad file).
struct HandLaw {
  dynamics::HandFunction function;
  /// At `time` by the law that holds at `within`: a step that begins or ends at a break sees its own side of it. Empty: `function`.
  std::function<dynamics::HandSample(double time, double within)> sided = {};
  dynamics::HandSegment segment(double t0, double dt) const {
    if (!sided) return dynamics::makeSegment(function, t0, dt);
    const double within = t0 + dt / 2;
    return dynamics::makeSegment([&](double t) { return sided(t, within); }, t0, dt);
  }
  std::vector<double> breaks = {};  // [s] increasing
};
HandLaw makeHandLaw(const std::string& name, const experiment::Experiment& experiment, const constraints::Constraint& constraint);

}  // namespace reachlab::cli
