#include "sim/predict/least_effort.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "constraints/error.h"
#include "sim/predict/gauss_legendre.h"

namespace reachlab {
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

// y = A x, over the first `rows` states; zeros are skipped by the compressed rows.
template <class Real>
class SparseRows {
 public:
  SparseRows(const LineSystem<Real>& system, int rows, bool transposed) : begin_(1, 0) {
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < rows; ++j) {
        const Real& value = transposed ? system.a[static_cast<size_t>(j) * system.size + i] : system.a[static_cast<size_t>(i) * system.size + j];
        if (static_cast<double>(value) == 0) continue;
        column_.push_back(j);
        value_.push_back(value);
      }
      begin_.push_back(static_cast<int>(value_.size()));
    }
  }

  void multiply(const std::vector<Real>& x, Real factor, std::vector<Real>& y) const {
    for (size_t i = 0; i + 1 < begin_.size(); ++i) {
      Real sum = 0.0;
      for (int p = begin_[i]; p < begin_[i + 1]; ++p) sum += value_[p] * x[column_[p]];
      y[i] = factor * sum;
    }
  }

  /// Square root of the product of row and column sums, an upper bound of the spectral norm.
  double norm() const {
    std::vector<double> columns(begin_.size(), 0.0);
    double most = 0;
    for (size_t i = 0; i + 1 < begin_.size(); ++i) {
      double row = 0;
      for (int p = begin_[i]; p < begin_[i + 1]; ++p) {
        const double size = std::abs(static_cast<double>(value_[p]));
        row += size;
        columns[column_[p]] += size;
      }
      most = std::max(most, row);
    }
    return std::sqrt(most * *std::max_element(columns.begin(), columns.end()));
  }

 private:
  std::vector<int> begin_, column_;
  std::vector<Real> value_;
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

// Householder triangularisation of `columns` (each a vector of samples); R is left in `r`, column by column.
template <class Real>
void triangularise(std::vector<std::vector<Real>>& columns, std::vector<std::vector<Real>>& r) {
  const size_t n = columns.size(), rows = columns[0].size();
  r.assign(n, std::vector<Real>(n, Real(0.0)));
  for (size_t k = 0; k < n; ++k) {
    std::vector<Real>& v = columns[k];
    Real square = 0.0;
    for (size_t i = k; i < rows; ++i) square += v[i] * v[i];
    Real alpha = sqrt(square);
    if (v[k] > Real(0.0)) alpha = -alpha;
    for (size_t i = 0; i < k; ++i) r[k][i] = v[i];
    r[k][k] = alpha;
    v[k] -= alpha;
    const Real half = square - (v[k] + alpha) * alpha;  // v^T v / 2
    for (size_t j = k + 1; j < n; ++j) {
      std::vector<Real>& c = columns[j];
      Real product = 0.0;
      for (size_t i = k; i < rows; ++i) product += v[i] * c[i];
      product /= half;
      for (size_t i = k; i < rows; ++i) c[i] -= product * v[i];
    }
  }
}

double computeCondition(const std::vector<std::vector<double>>& r) {
  Eigen::MatrixXd m(r.size(), r.size());
  for (size_t j = 0; j < r.size(); ++j)
    for (size_t i = 0; i < r.size(); ++i) m(i, j) = r[j][i];
  const Eigen::VectorXd sizes = Eigen::BDCSVD<Eigen::MatrixXd>(m).singularValues();
  return sizes(0) / sizes(sizes.size() - 1);
}

}  // namespace

template <class Real>
LeastEffort solveLeastEffort(const LineSystem<Real>& system, double duration) {
  constexpr int kTerms = Precision<Real>::kTerms, kNodes = Precision<Real>::kNodes;
  const int m = system.controlled, n = system.size;
  const SparseRows<Real> a(system, n, false), controlled(system, m, false), adjoint(system, m, true);
  const double needed = std::ceil(std::max(1.0, a.norm() * duration / kRatePerPanel));
  if (!(needed <= kMaxPanels))
    throw RefusedError(fmt::format("the object's fastest rate, {:.3g} 1/s, is too stiff for a movement of {:.4g} s: less damping or "
                                   "heavier masses",
                                   a.norm(), duration));
  const int panels = static_cast<int>(needed);
  const Real width = Real(duration) / Real(static_cast<double>(panels));

  // Samples of e^{A (T-t)} b, times the root of the Gauss weight, from T backwards.
  const GaussRule<Real> rule = makeGaussRule<Real>(kNodes);
  std::vector<std::vector<Real>> terms(kTerms, std::vector<Real>(m));
  std::vector<std::vector<Real>> columns(m, std::vector<Real>(static_cast<size_t>(panels) * kNodes));
  std::vector<Real> vector(system.b.begin(), system.b.begin() + m);
  for (int p = 0; p < panels; ++p) {
    terms[0] = vector;
    expand(controlled, width, terms);
    for (int g = 0; g < kNodes; ++g) {
      const Real s = (rule.node[g] + Real(1.0)) / Real(2.0), root = sqrt(width * rule.weight[g] / Real(2.0));
      for (int i = 0; i < m; ++i) {
        Real sum = terms[kTerms - 1][i];
        for (int k = kTerms - 2; k >= 0; --k) sum = sum * s + terms[k][i];
        columns[i][static_cast<size_t>(p) * kNodes + g] = root * sum;
      }
    }
    sumTerms(terms, vector);
  }

  std::vector<Real> scale(m);
  for (int i = 0; i < m; ++i) {
    Real square = 0.0;
    for (const Real& c : columns[i]) square += c * c;
    scale[i] = Real(1.0) / sqrt(square);
    for (Real& c : columns[i]) c *= scale[i];
  }
  std::vector<std::vector<Real>> r;
  triangularise(columns, r);

  // W^-1 x_T = S R^-1 R^-T S x_T.
  std::vector<Real> solution(m);
  Real cost = 0.0;
  for (int i = 0; i < m; ++i) {
    Real value = scale[i] * system.target[i];
    for (int j = 0; j < i; ++j) value -= r[i][j] * solution[j];
    solution[i] = value / r[i][i];
    cost += solution[i] * solution[i];
  }
  for (int i = m - 1; i >= 0; --i) {
    for (int j = i + 1; j < m; ++j) solution[i] -= r[j][i] * solution[j];
    solution[i] /= r[i][i];
  }
  for (int i = 0; i < m; ++i) solution[i] *= scale[i];

  // The adjoint backwards to every panel's start (it would grow forwards), then the states forwards, both as Taylor series.
  std::vector<std::vector<Real>> adjointAt(panels + 1);
  adjointAt[panels] = solution;
  for (int p = panels; p-- > 0;) {
    terms[0] = adjointAt[p + 1];
    expand(adjoint, width, terms);
    sumTerms(terms, adjointAt[p]);
  }
  LeastEffort result;
  SeriesProfile& profile = result.profile;
  profile.outputs = static_cast<int>(system.output.size());
  profile.terms = kTerms;
  profile.panels = panels;
  profile.width = duration / panels;
  profile.coefficient.resize(static_cast<size_t>(panels) * profile.outputs * kTerms);
  std::vector<Real> state(n, Real(0.0)), control(kTerms);
  std::vector<std::vector<Real>> states(kTerms, std::vector<Real>(n));
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
    for (int o = 0; o < profile.outputs; ++o)
      for (int k = 0; k < kTerms; ++k) {
        Real value = system.output[o][n] * control[k];
        for (int i = 0; i < n; ++i) value += system.output[o][i] * states[k][i];
        profile.coefficient[(static_cast<size_t>(p) * profile.outputs + o) * kTerms + k] = static_cast<double>(value);
      }
  }
  for (int i = 0; i < m; ++i) result.miss = std::max(result.miss, std::abs(static_cast<double>(state[i] - system.target[i])));
  result.cost = static_cast<double>(cost);
  std::vector<std::vector<double>> rough(m, std::vector<double>(m));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) rough[j][i] = static_cast<double>(r[j][i]);
  result.condition = computeCondition(rough);
  return result;
}

template LeastEffort solveLeastEffort(const LineSystem<double>&, double);
template LeastEffort solveLeastEffort(const LineSystem<DoubleDouble>&, double);

}  // namespace reachlab
