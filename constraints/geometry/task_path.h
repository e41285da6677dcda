#pragma once
#include <memory>
#include <span>

#include "base/fault.h"
#include "base/math/vec3.h"
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// A place on the constraint by its parameters (three metres when free) [m]; not finite outside the domain, and for another number of
/// parameters than the constraint has. Any thread; never allocates.
Vec3 placeOn(const Constraint& constraint, std::span<const double> q) noexcept;

/// Of a task that leads nowhere.
Fault samePlaceFault();

/// The way from one place of a constraint to another and its direction: along the chord on a straight curve and in free space, along the
/// tangent on other curves, towards the target; on a surface there is none. A value; any thread.
class TaskPath {
 public:
  TaskPath();  // in free space, without a length
  /// Parameters as for placeOn.
  TaskPath(const Constraint& constraint, std::span<const double> start, std::span<const double> target);

  const Constraint& constraint() const { return *constraint_; }
  const Vec3& start() const { return start_; }    // [m]
  const Vec3& target() const { return target_; }  // [m]
  /// One direction everywhere.
  bool straight() const noexcept;
  /// A curve with a tangent of its own at each parameter.
  bool bent() const noexcept;
  /// Unit direction at a curve's parameter `q` (not looked at where straight), world frame; zero where there is none.
  Vec3 directionAt(double q) const noexcept;
  /// Velocity along the way of something at `q`, positive towards the target; its magnitude where there is no direction. [m/s]
  double velocityAlong(const Vec3& velocity, double q) const noexcept;

 private:
  std::shared_ptr<const Constraint> constraint_;
  Vec3 start_, target_, chord_;
  double sense_ = 1;  // of a curve's parameter
};

}  // namespace reachlab::constraints
