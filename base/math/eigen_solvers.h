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

/// Singular values of a square matrix, the largest first.
Eigen::VectorXd singularValues(const Eigen::MatrixXd& matrix);

}  // namespace reachlab
