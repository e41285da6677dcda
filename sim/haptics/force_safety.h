#pragma once
#include "base/vec3.h"

namespace reachlab::haptics {

/// The last thing before the device, independent of all that computes the force. In this order:
///   - a force that is not finite gives zero, and zero from then on (a latched fault) until `rearm`;
///   - not engaged, hand lost, or after a time gap: zero; when force returns it may grow to the limit within kRampSeconds only, which
///     a force that begins near zero never notices;
///   - the norm is clamped to the limit, direction kept;
///   - the change from one tick to the next is clamped to kSlewPerTick, direction kept. Going to zero is never slowed.
/// Haptic thread; neither allocates nor throws.
class ForceSafety {
 public:
  static constexpr double kRampSeconds = 0.2;
  static constexpr double kSlewPerTick = 2.0;  // [N/ms]; 600 N/m at 1 m/s needs 0.6

  /// `limit` > 0 [N]
  explicit ForceSafety(double limit) noexcept : limit_(limit) {}

  /// `engaged`: a trial is under way. `held`: the hand is known at this tick and no gap precedes it.
  Vec3 limit(const Vec3& force, bool engaged, bool held) noexcept;
  /// Clears the latch; when a new trial is put up.
  void rearm() noexcept { latched_ = false; }
  bool latched() const noexcept { return latched_; }
  double limit() const noexcept { return limit_; }

 private:
  double limit_;
  double rampTicks_ = 0;  // since force was allowed again
  bool latched_ = false;
  Vec3 last_;  // [N] what the device got at the tick before
};

}  // namespace reachlab::haptics
