#pragma once
#include "bench/reference.h"

namespace reachlab::bench {

/// References of linear scenes without integration. They are independent of the extrapolation, and the only quick ones for stiff or long
/// chains.

/// A chain whose coupling and springs are equal and undamped, by its modes in closed form. With a_j = (2j-1) pi / (4N+2), the frequencies
/// are w_j = 2 sqrt(k/m) sin a_j. The shapes are shape_j(i) = cos((2i-1) a_j), counted from the free end. The quintic hand drives each
/// mode: the particular solution is h - h''/w^2 + h''''/w^4. A free oscillation is added, so that the mode starts at rest.
Reference modalChainReference(const BenchScene& scene);

/// Any linear scene of few states: y(t + 0.01) = exp(0.01 A) y(t), where y also holds the hand and its five derivatives. A Taylor series,
/// scaled and squared, in 113 bits.
Reference exponentialReference(const BenchScene& scene);

}  // namespace reachlab::bench
