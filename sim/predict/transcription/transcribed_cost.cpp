#include "sim/predict/transcription/transcribed_cost.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace reachlab::predict {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// A basis at the nodes of its rule, derivatives by x: what depends on neither the problem nor its duration.
struct BasisTable {
  int order = 0, columns = 0;
  GaussRule rule;
  std::vector<Matrix> at;  // of each node: (order + 1) x columns
};

namespace {

std::shared_ptr<const BasisTable> makeTable(const RestToRestBasis& basis) {
  auto table = std::make_shared<BasisTable>();
  table->order = basis.order();
  table->columns = basis.columns();
  table->rule = makeGaussRule(3 * (basis.columns() - 1 + basis.order()) / 2 + 8);
  for (const double x : table->rule.node) {
    table->at.emplace_back(basis.order() + 1, basis.columns());
    basis.tabulate(x, 1, table->at.back().data());
  }
  return table;
}

/// The last few are kept: a family of durations asks for the same ones again and again.
std::shared_ptr<const BasisTable> tableOf(const RestToRestBasis& basis) {
  constexpr size_t kKept = 8;
  static std::mutex mutex;
  static std::vector<std::shared_ptr<const BasisTable>> kept;  // the latest last
  const std::lock_guard lock(mutex);
  const auto known = std::find_if(kept.begin(), kept.end(),
                                  [&](const auto& table) { return table->order == basis.order() && table->columns == basis.columns(); });
  if (known != kept.end()) {
    std::rotate(known, known + 1, kept.end());
    return kept.back();
  }
  if (kept.size() == kKept) kept.erase(kept.begin());
  kept.push_back(makeTable(basis));
  return kept.back();
}

}  // namespace

void TranscribedProblem::takeDerivativesAsLocals() {
  locals = 4 * static_cast<int>(from.size());
  for (size_t motion = 0; motion < from.size(); ++motion) {
    local.emplace_back(locals * 4, 0.0);
    for (size_t m = 0; m < 4; ++m) local.back()[(motion * 4 + m) * 4 + m] = 1;
  }
}

TranscribedCost::TranscribedCost(const TranscribedProblem& problem, const RestToRestBasis& basis)
    : problem_(problem), table_(tableOf(basis)) {
  const int unknowns = basis.columns() - 1, motions = static_cast<int>(problem.from.size()), nodes = static_cast<int>(table_->at.size());
  const int locals = problem.locals, width = problem.order + 1;
  WorkLimit::hold(2.0 * nodes * locals * motions * unknowns);
  problem.work->spend(1.0 * nodes * locals * width * motions * unknowns);
  rows_.resize(nodes * locals, motions * unknowns);
  fixed_ = Vector::Zero(nodes * locals);
  Matrix all(locals, basis.columns());
  for (int motion = 0; motion < motions; ++motion) {
    const auto m = static_cast<size_t>(motion);
    Matrix local =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(problem.local[m].data(), locals, width);
    double rate = 1;  // d^m/dt^m = (2/T)^m d^m/dx^m
    for (int k = 0; k < width; ++k, rate *= 2 / problem.duration) local.col(k) *= rate;
    for (int node = 0; node < nodes; ++node) {
      all.noalias() = local * table_->at[node];
      fixed_.segment(node * locals, locals) += all.col(0) * (problem.to[m] - problem.from[m]) + local.col(0) * problem.from[m];
      rows_.block(node * locals, motion * unknowns, locals, unknowns) = all.rightCols(unknowns);
    }
  }
}

double TranscribedCost::weight(int node) const { return table_->rule.weight[node] * problem_.duration / 2; }

double TranscribedCost::evaluate(const Vector& unknowns) const {
  problem_.work->spend(static_cast<double>(rows_.size()));
  Vector a = fixed_;
  a.noalias() += rows_ * unknowns;
  std::vector<double> r(static_cast<size_t>(problem_.residuals));
  double sum = 0;
  for (int node = 0; node < static_cast<int>(table_->at.size()); ++node) {
    problem_.residual(&a[node * problem_.locals], r.data(), nullptr, nullptr);
    for (const double value : r) sum += weight(node) * value * value;
  }
  return sum;
}

double TranscribedCost::expand(const Vector& unknowns, Vector& gradient, Matrix& hessian) const {
  const int l = problem_.locals, nodes = static_cast<int>(table_->at.size());
  problem_.work->spend(static_cast<double>(rows_.size()) * static_cast<double>(l + rows_.cols() / 2 + 1));
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
