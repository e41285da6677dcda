#pragma once
#include <array>

#include "constraints/constraint.h"

namespace reachlab::dynamics {

/// Least-squares (u', v') [1/s] of a velocity [m/s]. On a pole itself one parameter is undetermined. The second parameter then carries the
/// velocity.
inline std::array<double, 2> solveRates(const constraints::SurfacePoint& p, const Vec3& v) noexcept {
  const double e = dot(p.rU, p.rU), f = dot(p.rU, p.rV), g = dot(p.rV, p.rV), a = dot(p.rU, v), b = dot(p.rV, v);
  const double determinant = e * g - f * f;
  if (determinant > 1e-24 * e * g) return {(g * a - f * b) / determinant, (e * b - f * a) / determinant};
  return e > g ? std::array{a / e, 0.0} : std::array{0.0, g > 0 ? b / g : 0.0};
}

}  // namespace reachlab::dynamics
