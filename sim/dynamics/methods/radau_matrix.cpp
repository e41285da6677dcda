#include "sim/dynamics/methods/radau_matrix.h"

#include "base/math/matrix.h"

namespace reachlab::dynamics {

struct RadauMatrix::Factors {
  explicit Factors(int size) : matrix(Eigen::MatrixXd::Identity(size, size)), factors(matrix), right(size), sorted(size) {}

  Eigen::MatrixXd matrix;
  Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>> factors;  // of `matrix`, in its place
  Eigen::VectorXd right, sorted;
};

RadauMatrix::RadauMatrix(int states)
    : n_(states), jacobian_(std::make_unique<double[]>(static_cast<std::size_t>(states * states))),
      factors_(std::make_unique<Factors>(kStages * states)) {}
RadauMatrix::~RadauMatrix() = default;

double* RadauMatrix::right() noexcept { return factors_->right.data(); }

bool RadauMatrix::factorise(double h) noexcept {
  Eigen::MatrixXd& matrix = factors_->matrix;
  for (int a = 0; a < kStages; ++a)
    for (int b = 0; b < kStages; ++b)
      for (int j = 0; j < n_; ++j)
        for (int i = 0; i < n_; ++i) matrix(a * n_ + i, b * n_ + j) = (a == b && i == j ? 1.0 : 0.0) - h * kA[a][b] * jacobian_[i * n_ + j];
  factors_->factors.compute(matrix);
  return matrix.diagonal().cwiseAbs().minCoeff() > 0;
}

// By parts, because solve() of Eigen would allocate a temporary.
void RadauMatrix::solve() noexcept {
  Factors& f = *factors_;
  f.sorted.noalias() = f.factors.permutationP() * f.right;
  f.matrix.triangularView<Eigen::UnitLower>().solveInPlace(f.sorted);
  f.matrix.triangularView<Eigen::Upper>().solveInPlace(f.sorted);
  f.right = f.sorted;
}

}  // namespace reachlab::dynamics
