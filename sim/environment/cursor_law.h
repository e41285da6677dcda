#pragma once
#include "sim/experiment/cursor.h"
#include "sim/experiment/task_plane.h"

namespace reachlab::environment {

/// The law of a cursor (experiment/cursor.h) for one trial: a pure function of the position of the hand. The delay concerns only the
/// picture. Any thread, never allocates.
class CursorLaw {
 public:
  /// `start` and `target` of the task [m].
  CursorLaw(const experiment::Cursor& cursor, experiment::TaskPlane plane, const Vec3& start, const Vec3& target) noexcept;
  /// The cursor [m] of a hand [m].
  Vec3 operator()(const Vec3& hand) const noexcept;
  bool isJudged() const noexcept { return judged_; }

 private:
  bool clamped_, judged_;
  Vec3 start_, normal_;  // [m], and of the plane
  Vec3 clampedAlong_;    // direction of a clamped cursor
  experiment::PlaneRotation rotation_;
  double gain_;
};

}  // namespace reachlab::environment
