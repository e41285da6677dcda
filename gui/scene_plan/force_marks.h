#pragma once
#include <vector>

#include "gui/scene_plan/constraint_mesh.h"
#include "sim/experiment/experiment_fwd.h"

namespace reachlab::gui::scene {

/// A force at a place, drawn as an arrow.
struct ForceArrow {
  Vec3 at, force;  // [m], [N]
};

/// The forces of an experiment on the hand, as they are drawn in the plane of the task. Empty without forces.
struct ForceMarks {
  std::vector<ForceArrow> field;  // sum of the fields around the line from start to target, for a hand that moves along it at `speed`
  double speed = 0;               // [m/s] peak of a minimum-jerk reach of the task; 0: no field depends on it
  std::vector<ForceArrow> pulses;
  SurfaceMesh channel;                      // from each wall to where the channel lets go; its lines are the walls
  std::vector<std::vector<Vec3>> letsGo;    // [m] dashes where it lets go
  double stiffness = 0, letGoDistance = 0;  // [N/m], [m] of the channel
  bool empty() const { return field.empty() && pulses.empty() && channel.quads.empty(); }
};
/// `start` and `target` of the task [m].
ForceMarks markForces(const experiment::Experiment& experiment, const Vec3& start, const Vec3& target);
/// [N]
double longestOf(const std::vector<ForceArrow>& arrows);

}  // namespace reachlab::gui::scene
