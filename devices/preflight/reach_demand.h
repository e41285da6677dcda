#pragma once
#include <optional>
#include <string>

#include "base/math/vec3.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::devices {

/// The demand of one reach of an experiment on the device that holds the hand.
struct ReachDemand {
  double peakForce = 0;  // [N] largest norm of the coupling's force while the object is held, unclamped
  double rmsForce = 0;   // [N] its root mean square from onset to the trial's end; compared with the continuous force of the motors
  double farthest = 0;   // [m] of the hand from the workspace's centre
  double duration = 0;   // [s] T that was asked for
  std::string law;       // the method of computation, as text
  bool withoutEnvironment = false;  // the law knows nothing of the forces on the hand that the experiment has
};

/// The reach of a practised subject without noise: minimum hand jerk for this very object (reach_plan.h). It runs through the engine that
/// computes the force, for every object on every constraint. Where no such subject can plan it, a rigid body's minimum-jerk reach replaces
/// it. Its peak force is F = m (10/sqrt 3) d/T^2 + m g with m the whole mass. Its root mean square is that of x''(t), sqrt(120/7) d/T^2.
/// `duration`: another T [s] than the task's. `centre`: centre of the device's workspace [m]. Throws FaultError without a task,
/// RefusedError when the scene cannot be computed.
ReachDemand computeReachDemand(const experiment::CompiledExperiment& experiment, std::optional<double> duration = std::nullopt,
                               const Vec3& centre = {});

}  // namespace reachlab::devices
