#include "sim/predict/least_effort.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/predict/gauss_legendre.h"
#include "sim/predict/sparse_rows.h"

namespace reachlab::predict {
namespace {

using std::sqrt;

constexpr double kRatePerPanel = 2;  // |A| times the width of a panel

// Terms of the exponential series at kRatePerPanel, and Gauss nodes that integrate the product of two such series, to rounding.
template <class Real>
struct Precision;
template <>
struct Precision<double> {
  static constexpr int kTerms = 26, kNodes = 10;
};
template <>
struct Precision<DoubleDouble> {
  static constexpr int kTerms = 42, kNodes = 16;
};

// terms[k] = (width A)^k x / k!
template <class Real>
void expand(const SparseRows<Real>& a, Real width, std::vector<std::vector<Real>>& terms) {
  for (size_t k = 0; k + 1 < terms.size(); ++k) a.multiply(terms[k], width / Real(static_cast<double>(k + 1)), terms[k + 1]);
}

template <class Real>
void sumTerms(const std::vector<std::vector<Real>>& terms, std::vector<Real>& out) {
  out = terms.back();
  for (size_t k = terms.size() - 1; k-- > 0;)
    for (size_t i = 0; i < out.size(); ++i) out[i] += terms[k][i];
}

// A square matrix, column by column.
template <class Real>
struct Square {
  explicit Square(int size) : n(size), value(static_cast<size_t>(size) * static_cast<size_t>(size), Real(0.0)) {}
  Real* column(int j) { return &value[static_cast<size_t>(j) * static_cast<size_t>(n)]; }
  const Real* column(int j) const { return &value[static_cast<size_t>(j) * static_cast<size_t>(n)]; }
  int n;
  std::vector<Real> value;
};

template <class Real>
Real dotOf(const Real* a, const Real* b, int count) {
  Real sum = 0.0;
  for (int i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}
template <>
double dotOf(const double* a, const double* b, int count) {
  return Eigen::Map<const Eigen::VectorXd>(a, count).dot(Eigen::Map<const Eigen::VectorXd>(b, count));
}

template <class Real>
void addScaled(Real* to, const Real* from, const Real& factor, int count) {
  for (int i = 0; i < count; ++i) to[i] += factor * from[i];
}

// Takes further rows into the triangular factor: R^T R grows by B^T B (`rows` x n, column by column; lost). Householder
// reflections of one row of R and all of B, Golub and Van Loan 12.5.
template <class Real>
void absorb(Square<Real>& r, std::vector<Real>& b, int rows) {
  for (int k = 0; k < r.n; ++k) {
    Real* mine = &b[static_cast<size_t>(k) * rows];
    Real& corner = r.column(k)[k];
    const Real square = dotOf(mine, mine, rows);
    if (!(square > Real(0.0))) continue;
    Real alpha = sqrt(corner * corner + square);
    if (corner > Real(0.0)) alpha = -alpha;
    const Real first = corner - alpha, inverse = Real(2.0) / (square + first * first);
    corner = alpha;
    for (int j = k + 1; j < r.n; ++j) {
      Real* other = &b[static_cast<size_t>(j) * rows];
      const Real product = inverse * (first * r.column(j)[k] + dotOf(mine, other, rows));
      r.column(j)[k] -= product * first;
      addScaled(other, mine, -product, rows);
    }
  }
}

// e^{A width}, column by column.
template <class Real>
Square<Real> computeExponential(const SparseRows<Real>& a, int n, Real width, std::vector<std::vector<Real>>& terms) {
  Square<Real> e(n);
  std::vector<Real> sum(static_cast<size_t>(n));
  for (int j = 0; j < n; ++j) {
    terms[0].assign(static_cast<size_t>(n), Real(0.0));
    terms[0][static_cast<size_t>(j)] = 1.0;
    expand(a, width, terms);
    sumTerms(terms, sum);
    std::copy(sum.begin(), sum.end(), e.column(j));
  }
  return e;
}

template <class Real>
double computeCondition(const Square<Real>& r) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(r.n, r.n);
  for (int j = 0; j < r.n; ++j) {
    for (int i = 0; i <= j; ++i) m(i, j) = static_cast<double>(r.column(j)[i]);
    m.col(j).normalize();
  }
  const Eigen::VectorXd sizes = Eigen::BDCSVD<Eigen::MatrixXd>(m).singularValues();
  return sizes(0) / sizes(sizes.size() - 1);
}

}  // namespace

template <class Real>
LeastEffort solveLeastEffort(const LineSystem<Real>& system, double duration) {
  constexpr int kTerms = Precision<Real>::kTerms, kNodes = Precision<Real>::kNodes;
  const int m = system.controlled, n = system.size;
  const SparseRows<Real> a(system, n, false), controlled(system, m, false), adjoint(system, m, true);
  double needed = 1;  // a power of two
  int doublings = 0;
  for (; needed * kRatePerPanel < a.norm() * duration && needed <= kMaxPanels; needed *= 2) ++doublings;
  if (!(needed <= kMaxPanels))
    throw RefusedError(
        fmt::format("the object's fastest rate, {:.3g} 1/s, is too stiff for a movement of {:.4g} s: less damping or "
                    "heavier masses",
                    a.norm(), duration));
  const int panels = static_cast<int>(needed);
  const Real width = Real(duration) / Real(needed);

  // Samples of e^{A s} b over the first panel, times the root of the Gauss weight, triangularised; then over twice as long, and
  // again.
  const GaussRule<Real> rule = makeGaussRule<Real>(kNodes);
  std::vector<std::vector<Real>> terms(kTerms, std::vector<Real>(m));
  terms[0].assign(system.b.begin(), system.b.begin() + m);
  expand(controlled, width, terms);
  std::vector<Real> rows(static_cast<size_t>(m) * kNodes);
  for (int g = 0; g < kNodes; ++g) {
    const Real s = (rule.node[g] + Real(1.0)) / Real(2.0), root = sqrt(width * rule.weight[g] / Real(2.0));
    for (int i = 0; i < m; ++i) {
      Real sum = terms[kTerms - 1][i];
      for (int k = kTerms - 2; k >= 0; --k) sum = sum * s + terms[k][i];
      rows[static_cast<size_t>(i) * kNodes + g] = root * sum;
    }
  }
  Square<Real> r(m);
  absorb(r, rows, kNodes);
  const Square<Real> panel = computeExponential(controlled, m, width, terms);
  Square<Real> step = panel;
  for (int d = 0; d < doublings; ++d) {
    rows.assign(static_cast<size_t>(m) * m, Real(0.0));  // R e^{A^T s}
    for (int k = 0; k < m; ++k)
      for (int j = 0; j < m; ++j) addScaled(&rows[static_cast<size_t>(j) * m], r.column(k), step.column(k)[j], k + 1);
    absorb(r, rows, m);
    if (d + 1 == doublings) break;
    Square<Real> twice(m);
    for (int j = 0; j < m; ++j)
      for (int k = 0; k < m; ++k) addScaled(twice.column(j), step.column(k), step.column(j)[k], m);
    step = std::move(twice);
  }

  // W^-1 x_T = R^-1 R^-T x_T.
  std::vector<Real> solution(m);
  Real cost = 0.0;
  for (int i = 0; i < m; ++i) {
    solution[i] = (system.target[i] - dotOf(r.column(i), solution.data(), i)) / r.column(i)[i];
    cost += solution[i] * solution[i];
  }
  for (int i = m - 1; i >= 0; --i) {
    solution[i] /= r.column(i)[i];
    addScaled(solution.data(), r.column(i), -solution[i], i);
  }

  // The adjoint backwards to every panel's start (it would grow forwards), then the states forwards, both as Taylor series.
  std::vector<std::vector<Real>> adjointAt(panels + 1, std::vector<Real>(m));
  adjointAt[panels] = solution;
  for (int p = panels; p-- > 0;)
    for (int i = 0; i < m; ++i) adjointAt[p][i] = dotOf(panel.column(i), adjointAt[p + 1].data(), m);
  LeastEffort result;
  SeriesProfile& profile = result.profile;
  profile.outputs = static_cast<int>(system.output.size());
  profile.terms = kTerms;
  profile.panels = panels;
  profile.width = duration / panels;
  profile.coefficient.resize(static_cast<size_t>(panels) * profile.outputs * kTerms);
  std::vector<Real> state(n, Real(0.0)), control(kTerms);
  std::vector<std::vector<Real>> states(kTerms, std::vector<Real>(n));
  Eigen::MatrixXd output(profile.outputs, n + 1), plain(n + 1, kTerms);
  for (int o = 0; o < profile.outputs; ++o)
    for (int i = 0; i <= n; ++i) output(o, i) = static_cast<double>(system.output[o][i]);
  for (int p = 0; p < panels; ++p) {
    terms[0] = adjointAt[p];
    expand(adjoint, -width, terms);
    for (int k = 0; k < kTerms; ++k) {
      control[k] = 0.0;
      for (int i = 0; i < m; ++i) control[k] += system.b[i] * terms[k][i];
    }
    states[0] = state;
    for (int k = 0; k + 1 < kTerms; ++k) {
      const Real factor = width / Real(static_cast<double>(k + 1));
      a.multiply(states[k], factor, states[k + 1]);
      for (int i = 0; i < n; ++i) states[k + 1][i] += factor * system.b[i] * control[k];
    }
    sumTerms(states, state);
    // Positions are sums of states of their own size: a double is enough.
    for (int k = 0; k < kTerms; ++k) {
      for (int i = 0; i < n; ++i) plain(i, k) = static_cast<double>(states[k][i]);
      plain(n, k) = static_cast<double>(control[k]);
    }
    Eigen::Map<Eigen::MatrixXd>(&profile.coefficient[static_cast<size_t>(p) * profile.outputs * kTerms], kTerms, profile.outputs)
        .noalias() = plain.transpose() * output.transpose();
  }
  for (int i = 0; i < m; ++i) result.miss = std::max(result.miss, std::abs(static_cast<double>(state[i] - system.target[i])));
  result.fastest = a.norm();
  result.cost = static_cast<double>(cost);
  result.condition = computeCondition(r);
  return result;
}

template LeastEffort solveLeastEffort(const LineSystem<double>&, double);
template LeastEffort solveLeastEffort(const LineSystem<DoubleDouble>&, double);

}  // namespace reachlab::predict
