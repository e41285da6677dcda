#pragma once
#include "base/math/vec3.h"
#include "constraints/constraint_spec.h"

namespace reachlab::dynamics {

/// The space of a linear object: one axis of a straight line r(phi) = origin + phi * tangent, or the three axes of free space.
struct LinearSpace {
  int axes = 1;
  Vec3 origin;                 // [m] r(0)
  Vec3 tangent;                // [m] r_phi, constant
  constraints::Domain domain;  // of phi
};

}  // namespace reachlab::dynamics
