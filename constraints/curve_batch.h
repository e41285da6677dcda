#pragma once
#include "base/math/lanes.h"
#include "constraints/constraint.h"

namespace reachlab::constraints {

/// CurvePoint for eight parameter values, by coordinate: r[k][i] is coordinate k of point i [m].
struct CurveBatch {
  alignas(64) double r[3][kBatchLanes];
  alignas(64) double rPhi[3][kBatchLanes];
  alignas(64) double rPhiPhi[3][kBatchLanes];
};

/// Evaluates eight points by eight single calls, for functions that have no batch form. Any thread. Never allocates.
void evaluateSingly(CurveFunction function, const void* program, const double* shape, const double* phi, CurveBatch& out) noexcept;

}  // namespace reachlab::constraints
