#include "sim/experiment/task_plane.h"

#include <numbers>

#include "base/math/elementary.h"

namespace reachlab::experiment {

Vec3 rightOf(const Vec3& along, const Vec3& normal) noexcept {
  const Vec3 right = cross(along, normal);
  const double length = norm(right);
  return length > 0 ? right / length : Vec3{};
}

PlaneRotation rotationInPlane(double degrees) noexcept {
  const double angle = degrees * (std::numbers::pi / 180);
  return {elementary::cos(angle), elementary::sin(angle)};
}

Vec3 rotated(const Vec3& v, const Vec3& normal, const PlaneRotation& rotation) noexcept {
  const Vec3 out = dot(v, normal) * normal, in = v - out;
  return out + rotation.cosine * in + rotation.sine * cross(normal, in);
}

}  // namespace reachlab::experiment
