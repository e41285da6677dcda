#pragma once
#include <array>

#include "sim/dynamics/hand_segment.h"

namespace reachlab {

inline constexpr int kForceTerms = HandSegment::kMaxDegree + 1;

/// The hand over one step as one axis of a linear object sees it.
struct AxisHand {
  std::array<double, kForceTerms> r{}, v{};  // polynomial coefficients [m], [m/s]
  int degree = 0;
  double extraForce = 0;  // [N] on mass 1
  double gravity = 0;     // [m/s^2]
};

}  // namespace reachlab
