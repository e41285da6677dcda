#pragma once
#include "base/math/matrix.h"

namespace reachlab::predict {

/// Least-norm motion from rest at -L/2 to rest at L/2 within tau in [-H, H] whose r-th derivative
///   g = sum_k polynomial_k P_k(tau/H) + sum_j trig_j c(W_j tau),   c = cos and k even for odd r, sin and k odd for even r,
/// Minimises the integral of g^2 under int g tau^k = 0 (k < r-1), int g tau^(r-1) = (-1)^(r-1) (r-1)! L and int g cos W_j tau = int g sin
/// W_j tau = 0. See docs/theory/criteria.md, "Least norm form". P_k are Legendre polynomials, which improve the conditioning.
struct MinNormMotion {
  int order = 3;               // r
  double halfTime = 0;         // [s] H
  Eigen::VectorXd polynomial;  // [m/s^r] of P_k, lowest k first
  Eigen::VectorXd trig;        // [m/s^r]
  double cost = 0;             // int g^2
  double condition = 0;        // of the triangular factor, columns of unit norm
};

/// 2 <= order <= 5, halfTime > 0, frequencies > 0 and distinct. Solved by QR of the basis sampled on Gauss-Legendre nodes of the
/// half interval. Not refused here: `condition` says how far the result may be trusted.
MinNormMotion solveMinNorm(int order, double distance, double halfTime, const Eigen::VectorXd& frequency);

}  // namespace reachlab::predict
