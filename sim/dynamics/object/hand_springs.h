#pragma once
#include <vector>

#include "base/math/vec3.h"
#include "sim/experiment/experiment_fwd.h"

namespace reachlab::dynamics {

/// The hold of one hand on the object: a spring and a damper to each mass (0: not held), or to a point of a body.
struct HandSprings {
  std::vector<double> stiffness, damping;  // [N/m], [N s/m], one per mass
  Vec3 fpOffset;                           // [m] body frame
};
/// The hands of the experiment. If it names no hands, there is a single hand with the coupling, or with the springs of a parallel object.
std::vector<HandSprings> handSpringsOf(const experiment::Experiment& experiment);

}  // namespace reachlab::dynamics
