#pragma once
#include "bench/reference.h"

namespace reachlab::bench {

/// References of linear scenes without integrating: independent of the extrapolation, and the only quick way for stiff or long chains.

/// A chain whose coupling and springs are equal and undamped, by its modes in closed form: w_j = 2 sqrt(k/m) sin((2j-1) pi / (4N+2)),
/// shape_j(i) = cos((2i-1) (2j-1) pi / (4N+2)) counted from the free end, each driven by the quintic hand: particular solution
/// h - h''/w^2 + h''''/w^4, plus the free oscillation that starts it at rest.
Reference modalChainReference(const BenchScene& scene);

/// Any linear scene of few states: y(t + 0.01) = exp(0.01 A) y(t), where y also holds the hand and its five derivatives. Taylor series,
/// scaled and squared, in 113 bits.
Reference exponentialReference(const BenchScene& scene);

}  // namespace reachlab::bench
