#pragma once
#include <vector>

#include "bench/quad.h"
#include "bench/scenes.h"

namespace reachlab::bench {

inline constexpr double kSampleEvery = 0.01;  // [s] errors are taken at these times

/// A scene's true motion at 0, 0.01, 0.02 … s. A row of `states` holds all generalised coordinates, then their rates (on a line: metres
/// from the start, m/s; past a pole: x, y, z and their rates); a row of `positions` holds x, y, z of every mass.
struct Reference {
  int stateSize = 0, massCount = 0, samples = 0;
  std::vector<Quad> states, positions;
};

struct ReferenceSettings {
  int columns = 13;          // of the extrapolation table: order 26
  double tolerance = 1e-29;  // of a step, relative to the largest state
};

/// A scene's reference by the quickest sure way: the great circle, the chain's modes, the matrix exponential, or extrapolation. Well over
/// 20 digits each; shares nothing with sim/dynamics. Under a second.
Reference computeReference(const BenchScene& scene);
/// Any scene but the geodesics, from its hand-written right-hand side in 113-bit arithmetic by extrapolation. Minutes for S1b500.
Reference extrapolatedReference(const BenchScene& scene, const ReferenceSettings& settings = {});

/// Largest differences of two references: states, and positions [m].
struct Deviation {
  double state = 0, position = 0;
};
Deviation compare(const Reference& a, const Reference& b);

}  // namespace reachlab::bench
