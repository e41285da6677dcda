#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "sim/dynamics/hand/hand_segment.h"
#include "sim/dynamics/object/mass_state.h"

namespace reachlab::dynamics {

/// A scene compiled for exactly one experiment: dynamics and method together (docs/adr/0002-a-scene-is-compiled-to-form-and-method.md).
/// Not thread-safe; the haptic loop owns it. None of the noexcept members allocates, locks or throws. A function of its inputs alone: the
/// same calls give the same bits.
class Plant {
 public:
  virtual ~Plant() = default;

  virtual int massCount() const noexcept = 0;
  /// All masses at rest at constraint parameters `q` (three metres when free); forgets the method's history and the faults.
  virtual void placeAtRest(std::span<const double> q) noexcept = 0;
  /// All masses at parameters q with rates qRate.
  virtual void place(std::span<const double> q, std::span<const double> qRate) noexcept = 0;
  /// A body's angular velocity [rad/s], world axes; place() sets it to zero and the orientation to none. Nothing for other objects.
  virtual void setAngularVelocity(const Vec3&) noexcept {}
  /// A constant extra force on mass 1 [N], world frame.
  virtual void setExtraForce(const Vec3& force) noexcept = 0;
  /// False switches the coupling off (no hand).
  virtual void setCoupled(bool coupled) noexcept = 0;

  /// Advances by dt [s] while the hand follows `hand`. On anything but Ok the state stays as it was (AtEnd, NoContinuation: the state is
  /// the last one on the constraint).
  [[nodiscard]] virtual StepStatus step(const HandSegment& hand, double dt) noexcept = 0;
  /// False where a step looks at the hand's position alone: its velocity need not be interpolated.
  virtual bool needsHandVelocity() const noexcept { return true; }
  /// How much of the last step's dt went by: less than 1 only after AtEnd and NoContinuation.
  virtual double lastStepFraction() const noexcept { return 1; }
  /// The hand's motion has broken (a jump, a gap): multistep methods start anew. State unchanged.
  virtual void restart() noexcept = 0;

  /// World state of every mass now, given the hand now (needed for accelerations). masses.size() >= massCount().
  virtual void observe(const HandSample& hand, std::span<MassState> masses) const noexcept = 0;
  /// Force of the hand on the object now, Eq. (8) (parallel: the sum over its springs) [N], unclamped.
  virtual Vec3 couplingForce(const HandSample& hand) const noexcept = 0;
  /// Kinetic + elastic (springs and coupling) + gravity energy [J].
  virtual double energy(const HandSample& hand) const noexcept = 0;
  virtual BodyState body() const noexcept { return {}; }

  /// Right-hand sides evaluated since construction, and the largest number within one step.
  virtual std::uint64_t rhsEvaluations() const noexcept = 0;
  /// Local error estimate of the last step, as a position [m]; 0 where the method is exact.
  virtual double errorEstimate() const noexcept { return 0; }
  /// Why an AtEnd / NoContinuation step stopped, in words. Not for the haptic thread.
  virtual std::string stopReason() const { return {}; }
};

}  // namespace reachlab::dynamics
