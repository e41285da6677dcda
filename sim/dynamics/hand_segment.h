#pragma once
#include <array>

#include "constraints/vec3.h"

namespace reachlab {

/// The HIP during one step, a polynomial in s = t/dt in [0, 1]: r(s) = sum position[k] s^k [m], v(s) = sum velocity[k] s^k [m/s].
/// Velocity has its own polynomial, because for a device it comes from an estimator and not from the positions; for a hand given as a
/// function it is the exact derivative. Degree 3 carries device samples, 7 a smooth function to rounding at 1 ms.
struct HandSegment {
  static constexpr int kMaxDegree = 7;
  int degree = 0;
  std::array<Vec3, kMaxDegree + 1> position{};
  std::array<Vec3, kMaxDegree + 1> velocity{};
};

/// One hand sample in world coordinates, at the end of a tick. `valid` is false when the device was lost.
struct HandSample {
  Vec3 position;  // [m]
  Vec3 velocity;  // [m/s] estimated
  bool valid = true;
};

}  // namespace reachlab
