#pragma once
#include <functional>

#include "sim/dynamics/hand/hand_segment.h"

namespace reachlab::dynamics {

/// A hand that is known at every time [s]: position and exact derivative.
using HandFunction = std::function<HandSample(double time)>;

/// The segment of degree 7 through eight Chebyshev-Lobatto points of [t0, t0 + dt], for position and velocity separately. For a hand that
/// is smooth on the tick the error is below rounding at 1 ms. Not for the haptic thread.
HandSegment makeSegment(const HandFunction& hand, double t0, double dt);

}  // namespace reachlab::dynamics
