#pragma once
#include <algorithm>

#include "base/math/vec3.h"

namespace reachlab {

/// Distance [m] of a point from the straight line that ends at a and b, which may be the same point.
inline double distanceToSegment(const Vec3& point, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 way = b - a;
  const double square = dot(way, way), along = square > 0 ? std::clamp(dot(point - a, way) / square, 0.0, 1.0) : 0;
  return norm(a + along * way - point);
}

}  // namespace reachlab
