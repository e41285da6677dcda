#include "sim/predict/transcription/transcribed_cost.h"

#include <cmath>

namespace reachlab::predict {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

TranscribedCost::TranscribedCost(const TranscribedProblem& problem, const RestToRestBasis& basis)
    : problem_(problem), rule_(makeGaussRule(3 * (basis.columns() - 1 + problem.order) / 2 + 8)) {
  const int unknowns = basis.columns() - 1, motions = static_cast<int>(problem.from.size()), nodes = static_cast<int>(rule_.node.size());
  const int locals = problem.locals, width = problem.order + 1;
  rows_.resize(nodes * locals, motions * unknowns);
  fixed_ = Vector::Zero(nodes * locals);
  Matrix table(width, basis.columns());
  for (int node = 0; node < nodes; ++node) {
    basis.tabulate(rule_.node[static_cast<size_t>(node)], 2 / problem.duration, table.data());
    for (int motion = 0; motion < motions; ++motion) {
      const auto m = static_cast<size_t>(motion);
      const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> local(problem.local[m].data(), locals,
                                                                                                           width);
      const Matrix all = local * table;
      fixed_.segment(node * locals, locals) += all.col(0) * (problem.to[m] - problem.from[m]) + local.col(0) * problem.from[m];
      rows_.block(node * locals, motion * unknowns, locals, unknowns) = all.rightCols(unknowns);
    }
  }
}

double TranscribedCost::evaluate(const Vector& unknowns) const {
  Vector a = fixed_;
  a.noalias() += rows_ * unknowns;
  std::vector<double> r(static_cast<size_t>(problem_.residuals));
  double sum = 0;
  for (int node = 0; node < static_cast<int>(rule_.node.size()); ++node) {
    problem_.residual(&a[node * problem_.locals], r.data(), nullptr, nullptr);
    for (const double value : r) sum += weight(node) * value * value;
  }
  return sum;
}

double TranscribedCost::expand(const Vector& unknowns, Vector& gradient, Matrix& hessian) const {
  const int l = problem_.locals, nodes = static_cast<int>(rule_.node.size());
  std::vector<double> r(problem_.residuals), ra(problem_.residuals * l), raa(problem_.residuals * l * l);
  Vector a = fixed_, g = Vector::Zero(a.size());
  a.noalias() += rows_ * unknowns;
  Matrix bent(rows_.rows(), rows_.cols()), h(l, l);
  double sum = 0;
  for (int node = 0; node < nodes; ++node) {
    problem_.residual(&a[node * l], r.data(), ra.data(), raa.data());
    h.setZero();
    for (int k = 0; k < problem_.residuals; ++k) {
      const double twice = 2 * weight(node);
      sum += weight(node) * r[k] * r[k];
      const Eigen::Map<const Vector> slope(&ra[k * l], l);
      g.segment(node * l, l) += twice * r[k] * slope;
      h += twice * (slope * slope.transpose() + r[k] * Eigen::Map<const Matrix>(&raa[k * l * l], l, l));
    }
    bent.middleRows(node * l, l).noalias() = h * rows_.middleRows(node * l, l);
  }
  gradient.noalias() = rows_.transpose() * g;
  hessian.resize(rows_.cols(), rows_.cols());
  hessian.triangularView<Eigen::Lower>() = rows_.transpose() * bent;
  hessian.triangularView<Eigen::StrictlyUpper>() = hessian.transpose();
  return sum;
}

}  // namespace reachlab::predict
