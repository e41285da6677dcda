#include "constraints/geometry/task_path.h"

#include <cmath>
#include <limits>

#include "constraints/constraint.h"

namespace reachlab::constraints {
namespace {

Vec3 unitOrZero(const Vec3& v) noexcept {
  const double length = norm(v);
  return length > 0 && std::isfinite(length) ? v / length : Vec3{};
}

}  // namespace

Vec3 placeOn(const Constraint& constraint, std::span<const double> q) noexcept {
  if (constraint.kind == ConstraintKind::Curve && q.size() == 1) return evaluate(constraint.curve, q[0]).r;
  if (constraint.kind == ConstraintKind::Surface && q.size() == 2) return evaluate(constraint.surface, q[0], q[1]).r;
  if (constraint.kind == ConstraintKind::Free && q.size() == 3) return {q[0], q[1], q[2]};
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  return {kNowhere, kNowhere, kNowhere};
}

Fault samePlaceFault() { return {"task.target", "start and target are the same position", "two positions"}; }

TaskPath::TaskPath(const Constraint& constraint, std::span<const double> start, std::span<const double> target)
    : constraint_(std::make_shared<const Constraint>(constraint)), start_(placeOn(constraint, start)), target_(placeOn(constraint, target)),
      chord_(unitOrZero(target_ - start_)) {
  if (constraint.kind == ConstraintKind::Curve && start.size() == 1 && target.size() == 1 && target[0] < start[0]) sense_ = -1;
}

TaskPath::TaskPath() : constraint_(std::make_shared<const Constraint>()) {}

bool TaskPath::straight() const noexcept { return constraint_->straight || constraint_->kind == ConstraintKind::Free; }

bool TaskPath::bent() const noexcept { return constraint_->kind == ConstraintKind::Curve && !constraint_->straight; }

Vec3 TaskPath::directionAt(double q) const noexcept {
  if (straight()) return chord_;
  return bent() ? sense_ * unitOrZero(evaluate(constraint_->curve, q).rPhi) : Vec3{};
}

double TaskPath::velocityAlong(const Vec3& velocity, double q) const noexcept {
  const Vec3 direction = directionAt(q);
  return direction == Vec3{} ? norm(velocity) : dot(velocity, direction);
}

}  // namespace reachlab::constraints
