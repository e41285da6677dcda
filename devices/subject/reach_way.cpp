#include "devices/subject/reach_way.h"

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "constraints/geometry/task_path.h"

namespace reachlab::devices {
namespace {

constexpr std::size_t kSteps = 2000;

}  // namespace

ReachWay::ReachWay(const experiment::CompiledExperiment& experiment) : constraint_(experiment.constraint()) {
  const experiment::Task& task = *experiment.experiment().task;
  start_ = constraints::placeOn(constraint_, task.start);
  const Vec3 target = constraints::placeOn(constraint_, task.target);
  const auto refuseNoWay = [] { throw FaultError(Fault{"task.target", "start and target are the same place", "two places"}); };
  if (constraint_.kind == constraints::ConstraintKind::Free || constraint_.straight) {
    length_ = norm(target - start_);
    if (!(length_ > 0)) refuseNoWay();
    direction_ = (target - start_) / length_;
    return;
  }
  if (constraint_.kind == constraints::ConstraintKind::Surface)
    throw RefusedError(
        "a subject with feedback needs one way from start to target, which a surface has not; allowed: lines and curves, or kind=plan");
  from_ = task.start[0];
  to_ = task.target[0];
  arc_.emplace(constraint_, from_, to_);
  length_ = arc_->length();
  if (!(length_ > 0)) refuseNoWay();
  const double sense = to_ < from_ ? -1 : 1;
  perMetreBefore_ = sense / norm(constraints::evaluate(constraint_.curve, from_).rPhi);
  perMetreAfter_ = sense / norm(constraints::evaluate(constraint_.curve, to_).rPhi);
  for (std::size_t i = 0; i <= kSteps; ++i) parameters_.push_back(arc_->parameterAt(length_ * static_cast<double>(i) / kSteps));
}

double ReachWay::parameterAt(double s) const noexcept {
  if (s < 0) return from_ + s * perMetreBefore_;
  if (s > length_) return to_ + (s - length_) * perMetreAfter_;
  return arc_->parameterAt(s);
}

ReachWay::Place ReachWay::at(double s) const noexcept {
  if (!arc_) return {start_ + s * direction_, direction_};
  const constraints::CurvePoint point = constraints::evaluate(constraint_.curve, parameterAt(s));
  const double pace = norm(point.rPhi) * (to_ < from_ ? -1 : 1);
  return {point.r, point.rPhi / pace};
}

double ReachWay::placeOf(const dynamics::MassState& mass) const noexcept {
  if (!arc_) return dot(mass.r - start_, direction_);
  const double q = mass.q[0], sense = to_ < from_ ? -1 : 1;
  if (sense * (q - from_) <= 0) return (q - from_) / perMetreBefore_;
  if (sense * (q - to_) >= 0) return length_ + (q - to_) / perMetreAfter_;
  const auto above =
      std::upper_bound(parameters_.begin(), parameters_.end(), q, [sense](double a, double b) { return sense * a < sense * b; });
  const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - parameters_.begin(), 1, kSteps));
  const double part = (q - parameters_[i - 1]) / (parameters_[i] - parameters_[i - 1]);
  return length_ * (static_cast<double>(i - 1) + part) / kSteps;
}

}  // namespace reachlab::devices
