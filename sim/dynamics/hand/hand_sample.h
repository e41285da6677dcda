#pragma once
#include "base/math/vec3.h"

namespace reachlab::dynamics {

/// One hand sample in world coordinates at the end of a tick. `valid` is false after the device was lost.
struct HandSample {
  Vec3 position;  // [m]
  Vec3 velocity;  // [m/s] estimated
  bool valid = true;
};

}  // namespace reachlab::dynamics
