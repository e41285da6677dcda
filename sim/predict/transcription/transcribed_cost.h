#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "base/math/gauss_legendre.h"
#include "base/math/matrix.h"
#include "sim/predict/numerics/work_limit.h"
#include "sim/predict/transcription/rest_to_rest_basis.h"

namespace reachlab::predict {

/// Least integral of |R(a)|^2 over [0, T], where the local variables a(t) are linear in the unknown motions. It is the problem of criterion
/// 2 and of jerk on curves and surfaces. Several motions may be unknown, each in the same RestToRestBasis.
struct TranscribedProblem {
  double duration = 0;  // [s]
  int order = 3;        // conditions per end of each motion
  int locals = 0, residuals = 0;
  std::vector<double> from, to;  // ends of each unknown motion
  std::vector<double> detour;    // how far bent starts leave each motion's straight one; empty: the way it goes, at least 1e-3
  /// locals x (order+1) for each motion: a = sum over motions and m of local[motion][l*(order+1)+m] * y^(m)(t), time derivatives.
  std::vector<std::vector<double>> local;
  /// Each motion, `from` says how many, and its first three derivatives become the local variables, motion by motion.
  void takeDerivativesAsLocals();
  /// R, dR/da (residuals x locals) and d2R/da2 (residuals x locals x locals) at one instant. R alone when ra is null.
  std::function<void(const double* a, double* r, double* ra, double* raa)> residual;
  /// Of all searches for its minimum together.
  std::shared_ptr<WorkLimit> work = std::make_shared<WorkLimit>();
};

/// That integral as a function of the unknowns, motion after motion, by Gauss-Legendre with three nodes for two unknowns. Gradient and
/// Hessian are exact. Borrows the problem. Throws RefusedError when its work exceeds the limit.
class TranscribedCost {
 public:
  TranscribedCost(const TranscribedProblem& problem, const RestToRestBasis& basis);
  double evaluate(const Eigen::VectorXd& unknowns) const;
  double expand(const Eigen::VectorXd& unknowns, Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) const;

 private:
  double weight(int node) const;

  const TranscribedProblem& problem_;
  std::shared_ptr<const struct BasisTable> table_;
  Eigen::MatrixXd rows_;   // the local variables at all nodes, node by node, of one unknown each
  Eigen::VectorXd fixed_;  // what the ends alone make of them
};

}  // namespace reachlab::predict
