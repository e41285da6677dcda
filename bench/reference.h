#pragma once
#include <vector>

#include "bench/quad.h"
#include "bench/scenes.h"

namespace reachlab::bench {

inline constexpr double kSampleEvery = 0.01;  // [s] errors are taken at these times

/// The true motion of a scene at 0, 0.01, 0.02 … s. A row of `states` holds all generalised coordinates, then their rates. On a line these
/// are metres from the start and m/s, past a pole x, y, z and their rates. A row of `positions` holds x, y, z of every mass.
struct Reference {
  int stateSize = 0, massCount = 0, samples = 0;
  std::vector<Quad> states, positions;
};

struct ReferenceSettings {
  int columns = 13;          // of the extrapolation table: order 26
  double tolerance = 1e-29;  // of a step, relative to the largest state
};

/// The reference of a scene by its quickest reliable method: the great circle, the modes of a long chain, or extrapolation. It has well over
/// 20 digits, shares no code with sim/dynamics, and takes less than a second, or some seconds for S7b.
Reference computeReference(const BenchScene& scene);
/// Any scene except the geodesics, from its hand-written right-hand side in 113-bit arithmetic by extrapolation. It takes minutes for
/// S1b500.
Reference extrapolatedReference(const BenchScene& scene, const ReferenceSettings& settings = {});
/// A chain whose coupling and springs are equal and undamped, by its modes in closed form. With a_j = (2j-1) pi / (4N+2), the frequencies
/// are w_j = 2 sqrt(k/m) sin a_j. The shapes are shape_j(i) = cos((2i-1) a_j), counted from the free end. The quintic hand drives each
/// mode: the particular solution is h - h''/w^2 + h''''/w^4. A free oscillation is added, so that the mode starts at rest.
Reference modalChainReference(const BenchScene& scene);

}  // namespace reachlab::bench
