#pragma once
#include <vector>

#include "base/math/vec3.h"
#include "sim/experiment/experiment_fwd.h"

namespace reachlab::dynamics {

/// How one hand holds the object: a spring and a damper to each mass (0: not held), or to a place on a body.
struct HandSprings {
  std::vector<double> stiffness, damping;  // [N/m], [N s/m], one a mass
  Vec3 fpOffset;                           // [m] body frame
};
/// The experiment's hands; one by the coupling, or a parallel object's springs, where it names none.
std::vector<HandSprings> handSpringsOf(const experiment::Experiment& experiment);

}  // namespace reachlab::dynamics
