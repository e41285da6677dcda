#pragma once
#include <cstdint>

#include "base/math/vec3.h"

namespace reachlab::haptics {

/// The forces that a device can bear.
struct ForceLimits {
  double instantaneous = 12;   // [N] > 0
  double continuous = 0;       // [N] for ever; 0: unknown, no budget is kept
  double thermalSeconds = 10;  // [s] time constant of the budget, > 0
};

/// The last thing before the device, independent of all that computes the force. In this order:
///   - a force that is not finite gives zero, and zero from then on (a latched fault) until `rearm`;
///   - not engaged, hand lost, or after a time gap: zero; when force returns it may grow to the limit within kRampSeconds only, which
///     a force that begins near zero never notices;
///   - the norm is clamped to the instantaneous limit, direction kept; where the continuous one is known, also to the budget: heat
///     follows h' = (F^2 - h)/tau, and between 80 and 100 % of h = Fc^2 the limit falls from the instantaneous to the continuous one, so
///     that the force's mean square over tau never exceeds Fc^2;
///   - the change from one tick to the next is clamped to kSlewPerTick, direction kept. Going to zero is never slowed.
/// Haptic thread. Neither allocates nor throws.
class ForceSafety {
 public:
  static constexpr double kRampSeconds = 0.2;
  static constexpr double kSlewPerTick = 2.0;  // [N/ms]; 600 N/m at 1 m/s needs 0.6

  explicit ForceSafety(const ForceLimits& limits) noexcept : limits_(limits) {}

  /// `engaged`: a trial is under way. `held`: the hand is known at this tick and no gap precedes it.
  Vec3 limit(const Vec3& force, bool engaged, bool held) noexcept;
  /// Clears the latch, not the heat. Called when a new trial is queued.
  void rearm() noexcept { latched_ = false; }
  bool latched() const noexcept { return latched_; }
  double limit() const noexcept { return limits_.instantaneous; }
  /// Interventions on the latest force: bits of `intervention` (hand_guard.h).
  std::uint8_t interventions() const noexcept { return interventions_; }
  /// Share of the budget that is used up: 1 where only the continuous force is left.
  double heat() const noexcept;

 private:
  Vec3 bound(const Vec3& force) noexcept;

  ForceLimits limits_;
  double rampTicks_ = 0;  // since force was allowed again
  double heat_ = 0;       // [N^2]
  bool latched_ = false;
  std::uint8_t interventions_ = 0;
  Vec3 last_;  // [N] what the device got at the tick before
};

}  // namespace reachlab::haptics
