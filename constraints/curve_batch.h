#pragma once
#include "base/math/lanes.h"

namespace reachlab::constraints {

struct CurvePoint;

/// CurvePoint for eight parameter values, by coordinate: r[k][i] is coordinate k of point i [m].
struct CurveBatch {
  alignas(64) double r[3][kBatchLanes];
  alignas(64) double rPhi[3][kBatchLanes];
  alignas(64) double rPhiPhi[3][kBatchLanes];
};

/// CurveFunction for eight values of phi, with the same bits as one by one. Any thread; never allocates.
using CurveBatchFunction = void (*)(const void* program, const double* shape, const double* phi, CurveBatch& out) noexcept;

/// One by one, for what does not go in lanes.
void evaluateSingly(void (*function)(const void*, const double*, double, CurvePoint&) noexcept, const void* program, const double* shape,
                    const double* phi, CurveBatch& out) noexcept;

}  // namespace reachlab::constraints
