#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "sim/dynamics/hand/hand_segment.h"
#include "sim/dynamics/object/mass_state.h"

namespace reachlab::dynamics {

/// A scene compiled for exactly one experiment: dynamics and method together (docs/adr/0002-a-scene-is-compiled-to-form-and-method.md). Not
/// thread-safe: the haptic loop owns it. No noexcept member allocates, locks or throws. The plant is a function of its inputs alone: the
/// same calls give the same bits.
class Plant {
 public:
  virtual ~Plant() = default;

  virtual int massCount() const noexcept = 0;
  /// Puts all masses at constraint parameters `q` (three metres when free) with rates qRate. The plant forgets the history of the method and
  /// the faults.
  virtual void place(std::span<const double> q, std::span<const double> qRate) noexcept = 0;
  void placeAtRest(std::span<const double> q) noexcept {
    const std::array<double, 3> rest{};
    place(q, std::span(rest).first(q.size()));
  }
  /// Sets the angular velocity of a body [rad/s], world axes. place() sets it to zero and removes any rotation. No effect on other objects.
  virtual void setAngularVelocity(const Vec3&) noexcept {}
  /// A constant extra force on mass 1 [N], world frame.
  virtual void setExtraForce(const Vec3& force) noexcept = 0;
  /// False switches the coupling off, as if no hand were there.
  virtual void setCoupled(bool coupled) noexcept = 0;

  /// Advances by dt [s] while the hand follows `hand`. The state changes only if the status is Ok. The exceptions are AtEnd and
  /// NoContinuation, after which it is the last state on the constraint.
  [[nodiscard]] virtual StepStatus step(const HandSegment& hand, double dt) noexcept = 0;
  /// False where a step reads only the position of the hand, so that its velocity need not be interpolated.
  virtual bool needsHandVelocity() const noexcept { return true; }
  /// The share of the last dt that passed. It is less than 1 only after AtEnd and NoContinuation.
  virtual double lastStepFraction() const noexcept { return 1; }
  /// The motion of the hand has broken (a jump, a gap), and multistep methods start anew. The state is unchanged.
  virtual void restart() noexcept = 0;

  /// World state of every mass now, given the hand now (needed for accelerations). masses.size() >= massCount().
  virtual void observe(const HandSample& hand, std::span<MassState> masses) const noexcept = 0;
  /// Force of the hand on the object now, Eq. (8), unclamped [N]. For a parallel object it is the sum over its springs.
  virtual Vec3 couplingForce(const HandSample& hand) const noexcept = 0;
  /// Kinetic + elastic (springs and coupling) + gravity energy [J].
  virtual double energy(const HandSample& hand) const noexcept = 0;
  virtual BodyState body() const noexcept { return {}; }

  /// Right-hand sides evaluated since construction.
  virtual std::uint64_t rhsEvaluations() const noexcept = 0;
  /// The reason for which an AtEnd or NoContinuation step stopped, as text. Not for the haptic thread.
  virtual std::string stopReason() const { return {}; }
};

}  // namespace reachlab::dynamics
