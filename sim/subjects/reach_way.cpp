#include "sim/subjects/reach_way.h"

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"
#include "sim/experiment/experiment.h"

namespace reachlab::subjects {
namespace {

constexpr std::size_t kSteps = 2000;

}  // namespace

ReachWay::ReachWay(const experiment::CompiledExperiment& experiment) {
  const constraints::Constraint& constraint = experiment.constraint();
  const experiment::Task& task = *experiment.experiment().task;
  start_ = constraints::placeOn(constraint, task.start);
  const Vec3 chord = constraints::placeOn(constraint, task.target) - start_;
  if (constraint.kind == constraints::ConstraintKind::Free || constraint.straight) {
    length_ = norm(chord);
    if (!(length_ > 0)) throw FaultError(constraints::samePlaceFault());
    direction_ = chord / length_;
    return;
  }
  if (constraint.kind == constraints::ConstraintKind::Surface)
    throw RefusedError(
        "a subject with feedback needs one way from start to target, which a surface has not; allowed: lines and curves, or kind=plan");
  curve_.emplace(constraint, task.start[0], task.target[0]);
  length_ = curve_->length();
  for (std::size_t i = 0; i <= kSteps; ++i) parameters_.push_back(curve_->parameterAt(length_ * static_cast<double>(i) / kSteps));
}

ReachWay::Place ReachWay::at(double s) const noexcept {
  if (!curve_) return {start_ + s * direction_, direction_};
  const constraints::CurvePoint point = curve_->at(s);
  return {point.r, point.rPhi / (norm(point.rPhi) * curve_->sense())};
}

double ReachWay::placeOf(const dynamics::MassState& mass) const noexcept {
  if (!curve_) return dot(mass.r - start_, direction_);
  const double q = mass.q[0], sense = curve_->sense();
  if (const double beyond = curve_->beyond(q); beyond != 0) return beyond < 0 ? beyond : length_ + beyond;
  const auto above =
      std::upper_bound(parameters_.begin(), parameters_.end(), q, [sense](double a, double b) { return sense * a < sense * b; });
  const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - parameters_.begin(), 1, kSteps));
  const double part = (q - parameters_[i - 1]) / (parameters_[i] - parameters_[i - 1]);
  return length_ * (static_cast<double>(i - 1) + part) / kSteps;
}

}  // namespace reachlab::subjects
