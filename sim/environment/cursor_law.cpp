#include "sim/environment/cursor_law.h"

namespace reachlab::environment {

CursorLaw::CursorLaw(const experiment::Cursor& cursor, experiment::TaskPlane plane, const Vec3& start, const Vec3& target) noexcept
    : clamped_(cursor.clamp.has_value()), judged_(cursor.judge == experiment::CursorJudge::Cursor), start_(start),
      normal_(experiment::normalOf(plane)), rotation_(experiment::rotationInPlane(cursor.rotation)), gain_(cursor.gain) {
  const Vec3 way = target - start;
  if (clamped_ && norm(way) > 0) clampedAlong_ = experiment::rotated(way / norm(way), normal_, experiment::rotationInPlane(*cursor.clamp));
}

Vec3 CursorLaw::operator()(const Vec3& hand) const noexcept {
  const Vec3 moved = hand - start_;
  return clamped_ ? start_ + norm(moved) * clampedAlong_ : start_ + gain_ * experiment::rotated(moved, normal_, rotation_);
}

}  // namespace reachlab::environment
