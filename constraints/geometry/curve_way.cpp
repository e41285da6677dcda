#include "constraints/geometry/curve_way.h"

#include <algorithm>

#include "base/fault.h"
#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"

namespace reachlab::constraints {

CurveWay::CurveWay(const Constraint& curve, double from, double to)
    : curve_(curve), arc_(curve, from, to), from_(from), to_(to), sense_(to < from ? -1 : 1) {
  if (!(length() > 0)) throw FaultError(samePlaceFault());
  const auto perMetre = [&](double parameter) { return sense_ / norm(evaluate(curve_.curve, parameter).rPhi); };
  before_ = perMetre(from);
  after_ = perMetre(to);
}

double CurveWay::parameterAt(double s) const noexcept {
  const double past = s < 0 ? s * before_ : s > length() ? (s - length()) * after_ : 0;
  return arc_.parameterAt(std::clamp(s, 0.0, length())) + past;
}

double CurveWay::beyond(double parameter) const noexcept {
  if (sense_ * (parameter - from_) < 0) return (parameter - from_) / before_;
  if (sense_ * (parameter - to_) > 0) return (parameter - to_) / after_;
  return 0;
}

}  // namespace reachlab::constraints
