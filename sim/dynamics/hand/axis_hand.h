#pragma once
#include "sim/dynamics/hand/hand_segment.h"

namespace reachlab::dynamics {

inline constexpr int kForceTerms = HandSegment::kMaxDegree + 1;
static_assert(sizeof(Vec3) == 3 * sizeof(double));

/// The hand over one step along one axis of a linear object. It is a view of the coefficients of a segment, one component of each Vec3.
struct AxisHand {
  static constexpr int kStride = 3;
  const double* position = nullptr;  // coefficient k at [k * kStride], k = 1 … degree | 1 [m]
  const double* velocity = nullptr;  // k = 0 … degree | 1 [m/s]; only where the hand is damped
  double origin = 0;                 // [m] coefficient 0 of the position, from the axis' origin
  int degree = 0;
  double extraForce = 0;  // [N] on mass 1
  double gravity = 0;     // [m/s^2]

  double r(int k) const noexcept { return position[k * kStride]; }
  double v(int k) const noexcept { return velocity[k * kStride]; }
};

/// Calls f with the degree as a constant, so that sums over coefficients unroll. Degrees 4 and 6, which no device's samples have, count as
/// 5 and 7, with coefficients that are zero.
template <class F>
auto withDegree(int degree, F&& f) noexcept {
  switch (degree) {
    case 0: return f(std::integral_constant<int, 0>{});
    case 1: return f(std::integral_constant<int, 1>{});
    case 2: return f(std::integral_constant<int, 2>{});
    case 3: return f(std::integral_constant<int, 3>{});
    case 4:
    case 5: return f(std::integral_constant<int, 5>{});
    default: return f(std::integral_constant<int, 7>{});
  }
}

}  // namespace reachlab::dynamics
