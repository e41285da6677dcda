#include "base/math/eigen_solvers.h"

#include <unsupported/Eigen/MatrixFunctions>

namespace reachlab {

SymmetricEigen solveSymmetric(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) { return matrix.eigenvalues(); }

Eigen::MatrixXd heldStep(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double dt) {
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(a.rows() + b.cols(), a.rows() + b.cols());
  block.topLeftCorner(a.rows(), a.cols()) = a * dt;
  block.topRightCorner(a.rows(), b.cols()) = b * dt;
  const Eigen::MatrixXd whole = block.exp();
  return whole.topRows(a.rows());
}

Eigen::VectorXd singularValues(const Eigen::MatrixXd& matrix) {
  return Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner>(matrix).singularValues();
}

}  // namespace reachlab
