#pragma once
#include <functional>

#include "base/math/vec3.h"

namespace reachlab::predict {

/// A hand in space at one instant.
struct PathPoint {
  Vec3 r, velocity, acceleration, jerk;  // [m], [m/s] …
};

/// How a computed movement looks on many more places than it was computed at.
struct PathCheck {
  double cost = 0;      // integral of |jerk|^2, as far as it is finite
  bool smooth = true;   // every derivative is the integral of the next
  double brokenAt = 0;  // [s] the first place where it is not, or where there is no value
};

/// Examines a movement in 96 equal intervals of [0, T], on sixteen Gauss nodes in each and at its ends. Over each interval r, velocity and
/// acceleration must change by the integral of their rates. This finds a kink, a jump, a step of the curvature, and a bump between the
/// nodes of the computation.
PathCheck checkPath(double duration, const std::function<PathPoint(double t)>& at);

}  // namespace reachlab::predict
