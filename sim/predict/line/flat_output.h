#pragma once
#include <vector>

#include "sim/predict/line/line_object.h"

namespace reachlab::predict {

/// A polynomial in D = d/dt, lowest power first.
using FlatPolynomial = std::vector<long double>;

/// Hand (0) and masses (1 … N) as polynomials of D applied to the flat output z (docs/theory/criteria.md, "Flat outputs"). Undamped: z is
/// the last mass of a chain. With dampers x_N = prod (1 + (b_j/k_j) D) z. The parallel object has z with h = prod (1 + (b_j/k_j) D +
/// (m_j/k_j) D^2) z. All coefficients are positive and right to rounding. The hand counts as massless, and the
/// force that drives it does not enter.
std::vector<FlatPolynomial> computeFlatPolynomials(const LineObject& object);

}  // namespace reachlab::predict
