#pragma once
#include <functional>

#include "sim/dynamics/hand_segment.h"

namespace reachlab::dynamics {

/// A hand known at every time [s]: position and exact derivative.
using HandFunction = std::function<HandSample(double time)>;

/// The segment of degree 7 through eight Chebyshev-Lobatto points of [t0, t0 + dt], for position and velocity separately. For a hand
/// that is smooth on the tick the error is below rounding at 1 ms. Not for the haptic thread.
HandSegment makeSegment(const HandFunction& hand, double t0, double dt);

/// The hand at rest at `position`.
HandSegment heldSegment(const Vec3& position) noexcept;

/// s(x) = 10 x^3 - 15 x^4 + 6 x^5 on [0, 1], held beyond: the minimum-jerk law, and ds/dx.
struct MinJerk {
  double s = 0, rate = 0;
};
MinJerk minJerk(double x) noexcept;

}  // namespace reachlab::dynamics
