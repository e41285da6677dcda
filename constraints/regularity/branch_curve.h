#pragma once
#include <limits>
#include <memory>

#include "constraints/constraint.h"
#include "constraints/formula/program.h"

namespace reachlab::constraints {

/// One branch of a curve's formula, as a separate curve. Beyond `lo` and `hi`, where the formula has no value, its tangent continues it.
struct BranchCurve {
  std::shared_ptr<const Program> program;
  double lo = -std::numeric_limits<double>::infinity(), hi = std::numeric_limits<double>::infinity();
};
/// `branch` must outlive it.
Curve curveOf(const BranchCurve& branch, const Curve& whole);

/// One side of a boundary between two branches.
struct BranchEnd {
  bool valid = false, bounded = true, settled = true;  // settled: r and r_phi have limits
  bool exact = false;                                  // the formula itself has them at the boundary
  CurvePoint limit;
  double edge = 0;   // the last phi at which the formula is evaluated
  double stop = 0;   // where a mass ends if it may not pass
  double slack = 0;  // [m] limits closer than this are one
};
/// Looks at a branch beside phi = `boundary`: `inwards` is its width, negative where it lies below. `branching`: nothing but branching
/// operations decides there, so that the formula may have a value on the boundary itself.
BranchEnd examineEnd(const Program& program, const double* shape, double boundary, double inwards, bool branching);

bool isFinite(const CurvePoint& p) noexcept;

}  // namespace reachlab::constraints
