#pragma once
#include <array>

#include "sim/dynamics/hand/hand_segment.h"

namespace reachlab::dynamics {

/// Farther than that in one tick, 20 m/s, no hand moves: the device has jumped.
inline constexpr double kLargestJump = 0.02;  // [m]

/// The last device samples, and the polynomial that the hand follows over the tick that ends at the newest. One sample: held; two: a
/// straight line; three: a parabola; four: a cubic. Position and velocity are interpolated alike, each through its own samples.
/// Measured on the chain of five at 1 ms against the true hand: held 2e-4 m, line 1e-7, parabola 5e-10, cubic 4e-11.
/// Haptic thread: neither allocates nor throws.
class HandPath {
 public:
  /// `mostSamples` 1 … 4 bounds the degree; `jump` [m] is how far a hand can move in one tick: beyond it the path is broken.
  explicit HandPath(int mostSamples = 4, double jump = kLargestJump) noexcept : most_(mostSamples), jump_(jump) {}

  /// Forgets everything; the next sample is held.
  void reset() noexcept { count_ = 0; }
  /// Takes the sample at the end of this tick. True if the path is continuous; false after a jump: this tick then follows a straight
  /// line to the new place, older samples are forgotten, and multistep methods must restart. An invalid or non-finite sample is not
  /// taken: the path ends (`reset`) and holds the last good place.
  bool push(const HandSample& sample) noexcept;
  /// The hand over the tick that ends at the newest sample. `withVelocity` false: zero velocity, for who does not look at it
  /// (Plant::needsHandVelocity).
  HandSegment segment(bool withVelocity = true) const noexcept;
  /// Samples that the segment goes through.
  int samples() const noexcept { return count_; }

 private:
  int most_;
  double jump_;
  int count_ = 0;
  bool broken_ = false;
  std::array<Vec3, 4> position_{}, velocity_{};  // newest first
};

}  // namespace reachlab::dynamics
