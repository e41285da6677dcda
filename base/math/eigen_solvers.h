#pragma once
#include "base/math/matrix.h"

/// Eigen's solvers for matrices whose size is known at run time, compiled once: each costs a compiler some ten seconds wherever it is used.
namespace reachlab {

struct SymmetricEigen {
  Eigen::VectorXd values;   // the smallest first
  Eigen::MatrixXd vectors;  // of unit length, in columns
};
SymmetricEigen solveSymmetric(const Eigen::MatrixXd& matrix);
/// The values alone.
Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix);

/// Eigenvalues of any square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/// The step of x' = A x + B u over `dt` with u held: [A_d B_d], the first rows of the exponential of [A B; 0 0] dt.
Eigen::MatrixXd heldStep(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double dt);

/// Singular values of a square matrix, the largest first.
Eigen::VectorXd singularValues(const Eigen::MatrixXd& matrix);

}  // namespace reachlab
