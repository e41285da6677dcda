#pragma once
#include <array>

#include "sim/dynamics/hand/hand_segment.h"

namespace reachlab::dynamics {

/// A hand that moves farther in one tick (20 m/s) does not exist: the device has jumped.
inline constexpr double kLargestJump = 0.02;  // [m]

/// The last device samples, and the polynomial that the hand follows over the tick that ends at the newest sample. One sample is held, two
/// make a straight line, three a parabola, four a cubic. Position and velocity are interpolated separately, each through the samples of its
/// kind. Errors on the chain of five at 1 ms against the true hand: held 2e-4 m, line 1e-7, parabola 5e-10, cubic 4e-11. Haptic thread.
/// Neither allocates nor throws.
class HandPath {
 public:
  /// `mostSamples` (1 … 4) bounds the degree. `jump` [m] is the largest movement of a hand in one tick. A larger movement breaks the path.
  explicit HandPath(int mostSamples = 4, double jump = kLargestJump) noexcept : most_(mostSamples), jump_(jump) {}

  /// Forgets all samples. The next sample is held.
  void reset() noexcept { count_ = 0; }
  /// Takes the sample at the end of this tick. Returns true if the path is continuous, and false after a jump. After a jump this tick
  /// follows a straight line to the new position, older samples are forgotten, and multistep methods must restart. An invalid or non-finite
  /// sample is not taken: the path ends (`reset`) and holds the last good position.
  bool push(const HandSample& sample) noexcept;
  /// The hand over the tick that ends at the newest sample. `withVelocity` false sets the velocity to zero, for plants that do not read it
  /// (Plant::needsHandVelocity).
  HandSegment segment(bool withVelocity = true) const noexcept;
  /// The number of samples that the segment goes through.
  int samples() const noexcept { return count_; }

 private:
  int most_;
  double jump_;
  int count_ = 0;
  bool broken_ = false;
  std::array<Vec3, 4> position_{}, velocity_{};  // newest first
};

}  // namespace reachlab::dynamics
