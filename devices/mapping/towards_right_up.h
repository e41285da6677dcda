#pragma once
#include "base/math/vec3.h"

/// The frame of devices whose x points towards the user, y to the right and z up. In the world x points to the right, y up and z towards the user.
namespace reachlab::devices {

inline Vec3 fromTowardsRightUp(const Vec3& v) noexcept { return {v.y, v.z, v.x}; }
inline Vec3 toTowardsRightUp(const Vec3& v) noexcept { return {v.z, v.x, v.y}; }

}  // namespace reachlab::devices
