#pragma once
#include "sim/predict/line_system.h"
#include "sim/predict/series_profile.h"

namespace reachlab::predict {

struct LeastEffort {
  SeriesProfile profile;
  double cost = 0;       // int u^2
  double condition = 0;  // of the triangular factor, columns of unit norm
  double fastest = 0;    // [1/s] bound of the object's rates
  double miss = 0;       // how far the states end from the target, in their own units: the computation checks itself
};

/// u(t) = b^T e^{A^T (T-t)} W^-1 x_T without forming W: the rows e^{A (T-t)} b are sampled on Gauss-Legendre nodes of short
/// panels, factorised by Householder reflections, and x, u continued as Taylor series panel by panel (criteria.md 5). Nothing is
/// squared, nothing is diagonalised: double eigenvalues and strong damping need no special case. Real is double or DoubleDouble.
/// Throws RefusedError when the fastest rate of the object times `duration` needs more than kMaxPanels panels.
template <class Real>
LeastEffort solveLeastEffort(const LineSystem<Real>& system, double duration);
inline constexpr int kMaxPanels = 20000;

}  // namespace reachlab::predict
