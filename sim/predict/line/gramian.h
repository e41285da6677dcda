#pragma once
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/math/eigen_solvers.h"
#include "sim/predict/line/scaled_system.h"

namespace reachlab::predict {

/// What happens within a time s: e^{A s} and the Gramian of s.
template <class Real>
struct Span {
  LaneMatrix<Real> e, w;
};

template <class Real>
Span<Real> makeShortSpan(const ControlProblem& system, const SparseRows& a, const Real& time, std::pmr::memory_resource* memory) {
  constexpr int kTerms = Precision<Real>::kShortTerms;
  const int n = system.size;
  const ScaledSystem<Real> scaled(memory, system, a, time);
  const std::pmr::vector<Real> inverse = makeInverses<Real>(memory, 2 * kTerms);
  const LaneMatrix<Real> one = LaneMatrix<Real>::identity(memory, n);
  LaneMatrix<Real> e = one.copy(), next(memory, n, n);
  for (int k = kTerms; k > 0; --k) {  // Horner
    scaled.multiply(e, inverse[k], &one, next);
    std::swap(e, next);
  }
  // With e^{A t} b = sum c_k (t/s)^k the integral of its square is s sum c_j c_k^T / (j + k + 1).
  const LaneMatrix<Real> impulse = makeImpulse<Real>(scaled, system, 1.0, inverse, kTerms, memory);
  LaneMatrix<Real> integral(memory, kTerms, kTerms);
  for (int j = 0; j < kTerms; ++j)
    for (int k = 0; k < kTerms; ++k) integral.set(j, k, time * inverse[j + k + 1]);
  return {std::move(e), transpose(impulse) * (integral * impulse)};
}

/// W(2s) = W(s) + e^{A s} W(s) e^{A^T s}. The products of each doubling are kept for the next doubling.
template <class Real>
class Doubling {
 public:
  Doubling(std::pmr::memory_resource* memory, int size)
      : turned_(memory, size, size), product_(memory, size, size), sum_(memory, size, size) {}
  void apply(Span<Real>& span) {
    transpose(span.e, turned_);
    multiply(span.e, span.w, product_);
    multiply(product_, turned_, sum_);
    span.w += sum_;
    multiply(span.e, span.e, product_);
    std::swap(span.e, product_);
  }

 private:
  LaneMatrix<Real> turned_, product_, sum_;
};

/// Right and left singular vectors of the coupling C of velocities and elongations, from those of C^T C. The left vectors are computed
/// separately where some C v are too small to determine them. Each state then belongs to about one mode of the object.
inline Eigen::MatrixXd makeTurn(const ControlProblem& system) {
  constexpr double kTellsLeft = 1e-6;
  const int m = system.controlled, e = system.elongations, v = system.velocities;
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(m, m), coupling(e, v);
  if (e == 0) return turn;
  for (int i = 0; i < e; ++i)
    for (int j = 0; j < v; ++j) coupling(i, j) = system.a[static_cast<size_t>(i) * system.size + e + j].hi;
  const SymmetricEigen right = solveSymmetric(coupling.transpose() * coupling);
  turn.block(e, e, v, v) = right.vectors;
  if (right.values[v - e] > kTellsLeft * right.values[v - 1])
    turn.topLeftCorner(e, e) = (coupling * right.vectors.rightCols(e)).colwise().normalized();
  else turn.topLeftCorner(e, e) = solveSymmetric(coupling * coupling.transpose()).vectors;
  return turn;
}

/// Condition of a triangle. The smallest singular value is computed as the largest of the inverse, so that it keeps its digits.
template <class Real>
double computeCondition(const std::pmr::vector<Real>& l, Eigen::Index n) {
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n), inverse = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) factor(i, j) = leading(l[i * n + j]);
  factor.triangularView<Eigen::Lower>().solveInPlace(inverse);
  if (!inverse.allFinite()) return std::numeric_limits<double>::infinity();
  const auto largest = [](const Eigen::MatrixXd& m) { return std::sqrt(symmetricEigenvalues(m * m.transpose())[m.rows() - 1]); };
  return largest(factor) * largest(inverse);
}

/// Of the triangle of W, from W's own eigenvalues: up to the condition at which a double is enough they have ten digits.
inline double computeCondition(const LaneMatrix<double>& w) {
  Eigen::MatrixXd m(w.rows(), w.rows());
  for (int i = 0; i < w.rows(); ++i)
    for (int j = 0; j < w.rows(); ++j) m(i, j) = w.at(i, j);
  const Eigen::VectorXd sizes = symmetricEigenvalues(m);
  return sizes[0] > 0 ? std::sqrt(sizes[sizes.size() - 1] / sizes[0]) : std::numeric_limits<double>::infinity();
}

/// W factorised in the object's modes, with its diagonal scaled to 1.
template <class Real>
class Gramian {
 public:
  Gramian(const ControlProblem& system, const LaneMatrix<Real>& w)
      : m_(system.controlled), size_(system.size), turn_(makeTurn(system)), unit_(static_cast<size_t>(m_), w.memory()), l_(w.memory()) {
    LaneMatrix<Real> controlled(w.memory(), m_, m_);
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) controlled.set(i, j, w.at(i, j));
    LaneMatrix<Real> turned = LaneMatrix<Real>(w.memory(), turn_.transpose()) * (controlled * LaneMatrix<Real>(w.memory(), turn_));
    for (int i = 0; i < m_; ++i) unit_[i] = 1 / std::sqrt(leading(turned.at(i, i)));
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) turned.set(i, j, Real(unit_[i]) * turned.at(i, j) * unit_[j]);
    l_ = factoriseCholesky(turned);
    if constexpr (std::is_same_v<Real, double>) condition_ = computeCondition(turned);
    else condition_ = computeCondition(l_, m_);
  }

  double condition() const { return condition_; }
  struct Solution {
    std::vector<Real> weights;  // W^-1 x, zero for what only follows
    double energy = 0;          // x^T W^-1 x
  };
  Solution solve(const std::vector<Real>& x) const {
    std::vector<Real> y(static_cast<size_t>(m_), 0.0);
    Real energy = 0.0;
    for (int i = 0; i < m_; ++i) {
      for (int j = 0; j < m_; ++j) y[i] += Real(turn_(j, i)) * x[j];
      y[i] *= unit_[i];
      for (int j = 0; j < i; ++j) y[i] -= l(i, j) * y[j];
      y[i] /= l(i, i);
      energy += y[i] * y[i];
    }
    for (int i = m_; i-- > 0;) {
      for (int j = i + 1; j < m_; ++j) y[i] -= l(j, i) * y[j];
      y[i] /= l(i, i);
    }
    for (int i = 0; i < m_; ++i) y[i] *= unit_[i];
    Solution solution{std::vector<Real>(static_cast<size_t>(size_), 0.0), static_cast<double>(energy)};
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) solution.weights[i] += Real(turn_(i, j)) * y[j];
    return solution;
  }

 private:
  const Real& l(int i, int j) const { return l_[static_cast<size_t>(i) * m_ + j]; }

  int m_, size_;
  Eigen::MatrixXd turn_;
  std::pmr::vector<double> unit_;
  std::pmr::vector<Real> l_;
  double condition_ = 0;
};

}  // namespace reachlab::predict
