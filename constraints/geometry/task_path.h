#pragma once
#include <memory>
#include <span>

#include "base/fault.h"
#include "base/math/vec3.h"
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// A point on the constraint, given by its parameters (three metres if free) [m]. It is not finite where the formula has no value, or if the number
/// of parameters differs from the constraint's. The ends of the domain are not looked at. Any thread. Never allocates.
Vec3 placeOn(const Constraint& constraint, std::span<const double> q) noexcept;

/// Of a task that leads nowhere.
Fault samePlaceFault();

/// The path from one point of a constraint to another, and its direction towards the target. The direction is along the chord on a straight
/// curve and in free space, and along the tangent on other curves. A surface has no direction. A value. Any thread.
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
  /// A curve whose tangent changes with the parameter.
  bool bent() const noexcept;
  /// Unit direction at a curve's parameter `q` in the world frame (`q` is ignored where straight). Zero if the path has no direction.
  Vec3 directionAt(double q) const noexcept;
  /// Speed along the path of a body at `q`, positive towards the target. Without a direction it is the magnitude. [m/s]
  double velocityAlong(const Vec3& velocity, double q) const noexcept;

 private:
  std::shared_ptr<const Constraint> constraint_;
  Vec3 start_, target_, chord_;
  double sense_ = 1;  // of a curve's parameter
};

}  // namespace reachlab::constraints
