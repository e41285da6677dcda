#pragma once
#include <array>

#include "base/math/fused.h"
#include "base/math/lanes.h"
#include "sim/dynamics/hand/hand_sample.h"

namespace reachlab::dynamics {

/// The HIP during one step, a polynomial in s = t/dt in [0, 1]. Position is r(s) = sum position[k] s^k [m], velocity is v(s) = sum
/// velocity[k] s^k [m/s]. Velocity has a separate polynomial, because a device gives it through an estimator. For a hand that is a function
/// it is the exact derivative. Degree 3 carries device samples, degree 7 a smooth function to rounding at 1 ms. Coefficients beyond the
/// degree are zero.
struct HandSegment {
  static constexpr int kMaxDegree = 7;
  using Coefficients = std::array<Vec3, kMaxDegree + 1>;
  int degree = 0;
  Coefficients position{}, velocity{};
};

/// Straight from one sample to the next.
inline HandSegment straightSegment(const HandSample& from, const HandSample& to) noexcept {
  return {1, {from.position, to.position - from.position}, {from.velocity, to.velocity - from.velocity}};
}

/// Value at s of a segment's polynomial [m] or [m/s].
inline Vec3 valueAt(const HandSegment::Coefficients& c, int degree, double s) noexcept {
  Vec3 value = c[degree];
  for (int k = degree - 1; k >= 0; --k) value = mulAdd(s, value, c[k]);
  return value;
}
/// The part of a segment between s0 and s1 as a new segment.
HandSegment part(const HandSegment& whole, double s0, double s1) noexcept;

inline HandSample sampleAt(const HandSegment& hand, double s) noexcept {
  return {valueAt(hand.position, hand.degree, s), valueAt(hand.velocity, hand.degree, s), true};
}

inline HandSample startOf(const HandSegment& hand) noexcept { return {hand.position[0], hand.velocity[0], true}; }
/// The sum of all coefficients, the lowest first.
inline Vec3 sumOf(const HandSegment::Coefficients& c) noexcept {
  // Three lanes of four. The last lane holds x of the next coefficient. Component by component the compiler takes three times as many
  // instructions.
  const double* from = &c[0].x;
  Lanes<4> sum = loadLanes<Lanes<4>>(from);
  for (int k = 1; k < HandSegment::kMaxDegree; ++k) sum += loadLanes<Lanes<4>>(from + 3 * k);
  const Vec3& last = c[HandSegment::kMaxDegree];
  return {sum[0] + last.x, sum[1] + last.y, sum[2] + last.z};
}
/// At s = 1, where multistep methods need it: without a loop of unknown length.
inline HandSample endOf(const HandSegment& hand) noexcept { return {sumOf(hand.position), sumOf(hand.velocity), true}; }

}  // namespace reachlab::dynamics
