#pragma once
#include <array>
#include <vector>

namespace reachlab {

/// Gauss-Legendre nodes (ascending) and weights on [-1, 1]; exact for polynomials of degree 2 count - 1.
struct GaussRule {
  std::vector<double> node, weight;
};
GaussRule makeGaussRule(int count);
/// The 16-point rule, computed once. Any thread.
const GaussRule& gaussRule16();

}  // namespace reachlab
