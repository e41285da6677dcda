#pragma once
#include <vector>

namespace reachlab::predict {

/// Gauss-Legendre nodes (ascending) and weights on [-1, 1]; exact for polynomials of degree 2 count - 1.
template <class Real>
struct GaussRule {
  std::vector<Real> node, weight;
};
/// Real is double (right to the last bit) or DoubleDouble.
template <class Real>
GaussRule<Real> makeGaussRule(int count);
/// The 16-point rule, computed once. Any thread.
const GaussRule<double>& gaussRule16();

}  // namespace reachlab::predict
