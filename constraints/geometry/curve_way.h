#pragma once
#include "constraints/constraint.h"
#include "constraints/geometry/arc_length.h"

namespace reachlab::constraints {

/// Position along a curve from one parameter to another, in metres of arc. Beyond both ends the position continues at the pace of that end,
/// because a hand that carries springs passes the target. A value. Any thread. A query neither allocates nor throws.
class CurveWay {
 public:
  /// Throws RefusedError as ArcLength does, FaultError (task.target) where the way has no length.
  CurveWay(const Constraint& curve, double from, double to);

  double length() const noexcept { return arc_.length(); }  // [m] > 0
  /// 1 where the parameter grows on the way, or -1.
  double sense() const noexcept { return sense_; }
  /// The parameter `s` [m] from the start.
  double parameterAt(double s) const noexcept;
  CurvePoint at(double s) const noexcept { return evaluate(curve_.curve, parameterAt(s)); }
  /// Distance [m] of a parameter before the start (negative) or beyond the target (positive). It is 0 between them.
  double beyond(double parameter) const noexcept;

 private:
  Constraint curve_;  // the whole of it, as a typed formula is owned by its constraint
  ArcLength arc_;
  double from_, to_, sense_;
  double before_, after_;  // the parameter's change per metre before the start and past the target
};

}  // namespace reachlab::constraints
