#pragma once
#include "sim/dynamics/hand/hand_segment.h"

namespace reachlab::dynamics {

/// The hand at rest at `position` [m].
inline HandSegment heldSegment(const Vec3& position) {
  HandSegment segment;
  segment.position[0] = position;
  return segment;
}

}  // namespace reachlab::dynamics
