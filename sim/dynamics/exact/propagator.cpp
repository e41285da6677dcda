#include "sim/dynamics/exact/propagator.h"

#include <algorithm>
#include <cmath>

namespace reachlab::dynamics {
namespace {

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Wide;
#else
using Wide = long double;  // 113 bits where the compiler has no __float128 (AArch64)
#endif

template <class T>
using Matrix = std::vector<T>;  // m x m, row by row

template <class T>
Matrix<T> product(const Matrix<T>& a, const Matrix<T>& b, int m) {
  Matrix<T> c(a.size(), T(0));
  for (int i = 0; i < m; ++i)
    for (int k = 0; k < m; ++k) {
      const T aik = a[i * m + k];
      if (aik == T(0)) continue;
      for (int j = 0; j < m; ++j) c[i * m + j] += aik * b[k * m + j];
    }
  return c;
}

template <class T>
std::vector<T> times(const Matrix<T>& a, const std::vector<T>& x, int m) {
  std::vector<T> y(m, T(0));
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) y[i] += a[i * m + j] * x[j];
  return y;
}

template <class T>
double largestRow(const Matrix<T>& a, int m) {
  double largest = 0;
  for (int i = 0; i < m; ++i) {
    double sum = 0;
    for (int j = 0; j < m; ++j) sum += std::abs(static_cast<double>(a[i * m + j]));
    largest = std::max(largest, sum);
  }
  return largest;
}

/// int_0^1 exp(A h (1-s)) b s^k ds = sum_p (A h)^p b k! / (p+k+1)!
template <class T>
std::vector<T> inputSeries(const Matrix<T>& ah, const std::vector<T>& b, int m, int k) {
  std::vector<T> sum(m, T(0)), term = b;
  T factor = T(1) / T(k + 1);
  for (int p = 0; p < 34; ++p) {
    for (int i = 0; i < m; ++i) sum[i] += factor * term[i];
    term = times(ah, term, m);
    factor /= T(p + k + 2);
  }
  return sum;
}

template <class T>
struct SecondOrder {
  std::vector<T> stiffness, damping;  // [1/s^2], [1/s]: n x n, row by row, divided by the masses
};

/// Assembled in T: in a double the hand's 600 N/m would drown beside a neighbour's 1e8.
template <class T>
SecondOrder<T> assemble(const ObjectModel& model, bool coupled) {
  const int n = model.count();
  SecondOrder<T> system{std::vector<T>(n * n, T(0)), std::vector<T>(n * n, T(0))};
  for (int i = 0; i < n; ++i) {
    system.damping[i * n + i] += T(model.viscosity) / T(model.mass[i]);
    if (coupled) {
      system.stiffness[i * n + i] += T(model.handStiffness[i]) / T(model.mass[i]);
      system.damping[i * n + i] += T(model.handDamping[i]) / T(model.mass[i]);
    }
  }
  for (int i = 0; i < static_cast<int>(model.stiffness.size()); ++i)
    for (const auto [row, other] : {std::array{i, i + 1}, std::array{i + 1, i}}) {
      const T k = T(model.stiffness[i]) / T(model.mass[row]), b = T(model.damping[i]) / T(model.mass[row]);
      system.stiffness[row * n + row] += k;
      system.stiffness[row * n + other] -= k;
      system.damping[row * n + row] += b;
      system.damping[row * n + other] -= b;
    }
  return system;
}

/// Rows to differences of neighbours, within positions and within velocities.
template <class T>
void takeDifferences(std::vector<T>& columns, int n, int width) {
  for (const int block : {0, n})
    for (int i = n - 1; i > 0; --i)
      for (int j = 0; j < width; ++j) columns[(block + i) * width + j] -= columns[(block + i - 1) * width + j];
}

/// Doubles the time of a step: d is the change of the state, q that of a force's powers of time, g that of gravity.
template <class T>
void doubleStep(Matrix<T>& d, std::array<std::vector<T>, kForceTerms>& q, std::vector<T>& g, int m) {
  std::array<std::vector<T>, kForceTerms> next;
  for (int k = 0; k < kForceTerms; ++k) {
    next[k] = times(d, q[k], m);
    T binomial = 1;
    for (int i = 0; i < m; ++i) next[k][i] += q[k][i];
    for (int j = 0; j <= k; ++j) {
      for (int i = 0; i < m; ++i) next[k][i] += binomial * q[j][i];
      binomial = binomial * T(k - j) / T(j + 1);
    }
    for (T& value : next[k]) value /= T(std::exp2(k));
  }
  q = next;
  const std::vector<T> dg = times(d, g, m);
  for (int i = 0; i < m; ++i) g[i] = 2 * g[i] + dg[i];
  const Matrix<T> dd = product(d, d, m);
  for (int i = 0; i < m * m; ++i) d[i] = 2 * d[i] + dd[i];
}

template <class T>
Propagator compute(const ObjectModel& model, bool coupled, double dt) {
  const int n = model.count(), m = 2 * n;
  const SecondOrder<T> system = assemble<T>(model, coupled);
  // Velocities are scaled by the fastest mode, which balances the blocks of A.
  double fastest = 1;
  for (int i = 0; i < n; ++i)
    fastest = std::max(
        {fastest, dt * std::sqrt(static_cast<double>(system.stiffness[i * n + i])), dt * static_cast<double>(system.damping[i * n + i])});
  const T unit = T(dt) / T(std::exp2(std::ceil(std::log2(fastest))));  // velocities in x per unit
  Matrix<T> a(m * m, T(0));
  for (int i = 0; i < n; ++i) {
    a[i * m + n + i] = T(dt) / unit;
    for (int j = 0; j < n; ++j) {
      a[(n + i) * m + j] = -system.stiffness[i * n + j] * T(dt) * unit;
      a[(n + i) * m + n + j] = -system.damping[i * n + j] * T(dt);
    }
  }
  int halvings = 0;
  for (double size = largestRow(a, m); size > 0.5; size /= 2) ++halvings;
  const T h = T(1) / T(std::exp2(halvings));
  for (T& value : a) value *= h;

  Matrix<T> d(m * m, T(0)), term(m * m, T(0));
  for (int i = 0; i < m; ++i) term[i * m + i] = T(1);
  for (int p = 1; p < 34; ++p) {
    term = product(term, a, m);
    for (T& value : term) value /= T(p);
    for (int i = 0; i < m * m; ++i) d[i] += term[i];
  }
  std::vector<T> input(m, T(0)), ones(m, T(0));
  input[n] = unit * T(dt) / T(model.mass[0]);
  for (int i = 0; i < n; ++i) ones[n + i] = unit * T(dt);
  std::array<std::vector<T>, kForceTerms> q;
  for (int k = 0; k < kForceTerms; ++k) q[k] = inputSeries(a, input, m, k);
  std::vector<T> g = inputSeries(a, ones, m, 0);
  for (auto& column : q)
    for (T& value : column) value *= h;
  for (T& value : g) value *= h;

  for (int doubling = 0; doubling < halvings; ++doubling) doubleStep(d, q, g, m);

  const auto scale = [&](int i) { return i < n ? T(1) : T(1) / unit; };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) d[i * m + j] *= scale(i) / scale(j);
  for (int i = 0; i < m; ++i) g[i] *= scale(i);
  takeDifferences(d, n, m);
  takeDifferences(g, n, 1);
  // Columns: x_i is the sum of the differences up to i.
  for (int i = 0; i < m; ++i)
    for (const int block : {0, n})
      for (int j = n - 2; j >= 0; --j) d[i * m + block + j] += d[i * m + block + j + 1];

  Propagator result;
  result.n = n;
  result.dt = dt;
  result.d.resize(m * m);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) result.d[j * m + i] = static_cast<double>(d[i * m + j]);
  for (int k = 0; k < kForceTerms; ++k) {
    for (int i = 0; i < m; ++i) q[k][i] *= scale(i);
    takeDifferences(q[k], n, 1);
    for (int i = 0; i < m; ++i) result.force[k].push_back(static_cast<double>(q[k][i]));
  }
  for (int i = 0; i < m; ++i) result.gravity.push_back(static_cast<double>(g[i]));
  return result;
}

}  // namespace

Propagator computePropagator(const ObjectModel& model, bool coupled, double dt) {
  return model.count() <= 24 ? compute<Wide>(model, coupled, dt) : compute<long double>(model, coupled, dt);
}

}  // namespace reachlab::dynamics
