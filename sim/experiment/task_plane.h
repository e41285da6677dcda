#pragma once
#include "base/math/vec3.h"
#include "sim/experiment/task.h"

namespace reachlab::experiment {

/// The unit vector that points from the plane of a task to its viewer: up from the horizontal plane, towards the subject from the frontal.
constexpr Vec3 normalOf(TaskPlane plane) noexcept { return plane == TaskPlane::Frontal ? Vec3{0, 0, 1} : Vec3{0, 1, 0}; }

/// The unit vector to the right of the direction `along`, in the plane with this normal. Zero if `along` is normal to the plane.
Vec3 rightOf(const Vec3& along, const Vec3& normal) noexcept;

/// A rotation in a plane, counterclockwise for a viewer whom its normal points at.
struct PlaneRotation {
  double cosine = 1, sine = 0;
};
PlaneRotation rotationInPlane(double degrees) noexcept;
/// `v` rotated in the plane with this normal. Its part along the normal stays.
Vec3 rotated(const Vec3& v, const Vec3& normal, const PlaneRotation& rotation) noexcept;

}  // namespace reachlab::experiment
