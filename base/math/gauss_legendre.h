#pragma once
#include <vector>

namespace reachlab {

/// Gauss-Legendre nodes (ascending) and weights on [-1, 1], exact for polynomials of degree 2 count - 1.
struct GaussRule {
  std::vector<double> node, weight;
};
/// Right to the last bit.
GaussRule makeGaussRule(int count);
/// The 16-point rule, computed once. Any thread.
const GaussRule& gaussRule16();

}  // namespace reachlab
