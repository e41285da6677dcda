#pragma once

namespace reachlab::constraints {

struct CurvePoint;

/// Points of a curve that are evaluated together, in the lanes of a vector register.
inline constexpr int kOctet = 8;

/// CurvePoint for eight parameter values, by coordinate: r[k][i] is coordinate k of point i [m].
struct CurveOctet {
  alignas(64) double r[3][kOctet];
  alignas(64) double rPhi[3][kOctet];
  alignas(64) double rPhiPhi[3][kOctet];
};

/// CurveFunction for eight values of phi, with the same bits as one by one. Any thread; never allocates.
using CurveOctetFunction = void (*)(const void* program, const double* shape, const double* phi, CurveOctet& out) noexcept;

/// One by one, for what does not go in lanes.
void evaluateSingly(void (*function)(const void*, const double*, double, CurvePoint&) noexcept, const void* program, const double* shape,
                    const double* phi, CurveOctet& out) noexcept;

}  // namespace reachlab::constraints
