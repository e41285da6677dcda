#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace reachlab::predict {

/// A number with its first and second derivatives with respect to Count variables: exact Hessians of a formula written once.
template <int Count>
struct HyperDual {
  double value = 0;
  std::array<double, Count> gradient{};
  std::array<double, Count * Count> hessian{};  // row by row; only j <= i is kept up to date

  HyperDual() = default;
  HyperDual(double constant) : value(constant) {}  // implicit on purpose: a constant is a HyperDual
  static HyperDual variable(int index, double at) {
    HyperDual jet(at);
    jet.gradient[index] = 1;
    return jet;
  }

  /// Value, gradient and the whole of the hessian to where the Newton matrix takes them from.
  void store(double* r, double* ra, double* raa) const {
    *r = value;
    for (int i = 0; i < Count; ++i) {
      ra[i] = gradient[i];
      for (int j = 0; j <= i; ++j) raa[i * Count + j] = raa[j * Count + i] = hessian[i * Count + j];
    }
  }

  /// f(x) with f, f', f'' at x.
  friend HyperDual chain(const HyperDual& x, double f, double f1, double f2) {
    HyperDual r(f);
    for (int i = 0; i < Count; ++i) r.gradient[i] = f1 * x.gradient[i];
    for (int i = 0; i < Count; ++i)
      for (int j = 0; j <= i; ++j) r.hessian[i * Count + j] = f1 * x.hessian[i * Count + j] + f2 * x.gradient[i] * x.gradient[j];
    return r;
  }
  friend HyperDual operator+(HyperDual a, const HyperDual& b) {
    a.value += b.value;
    for (int i = 0; i < Count; ++i) a.gradient[i] += b.gradient[i];
    for (int i = 0; i < Count; ++i)
      for (int j = 0; j <= i; ++j) a.hessian[i * Count + j] += b.hessian[i * Count + j];
    return a;
  }
  friend HyperDual operator-(const HyperDual& a) { return chain(a, -a.value, -1, 0); }
  friend HyperDual operator-(const HyperDual& a, const HyperDual& b) { return a + -b; }
  friend HyperDual operator*(const HyperDual& a, const HyperDual& b) {
    HyperDual r(a.value * b.value);
    for (int i = 0; i < Count; ++i) r.gradient[i] = a.value * b.gradient[i] + b.value * a.gradient[i];
    for (int i = 0; i < Count; ++i)
      for (int j = 0; j < Count; ++j)
        r.hessian[i * Count + j] = a.value * b.hessian[i * Count + j] + b.value * a.hessian[i * Count + j] + a.gradient[i] * b.gradient[j] +
                                   a.gradient[j] * b.gradient[i];
    return r;
  }
  friend HyperDual operator/(const HyperDual& a, const HyperDual& b) {
    const double q = 1 / b.value;
    return a * chain(b, q, -q * q, 2 * q * q * q);
  }
  friend HyperDual sin(const HyperDual& a) { return chain(a, std::sin(a.value), std::cos(a.value), -std::sin(a.value)); }
  friend HyperDual cos(const HyperDual& a) { return chain(a, std::cos(a.value), -std::sin(a.value), -std::cos(a.value)); }
  friend HyperDual acos(const HyperDual& a) {
    const double s = 1 - a.value * a.value, root = std::sqrt(s);
    return chain(a, std::acos(a.value), -1 / root, -a.value / (s * root));
  }
  friend HyperDual atan2(const HyperDual& y,
                         const HyperDual& x) {  // d = (x dy - y dx) / (x^2 + y^2): by the quotient that is smaller than one
    const bool flat = std::abs(y.value) <= std::abs(x.value);
    const HyperDual t = flat ? y / x : x / y;
    const double d = 1 / (1 + t.value * t.value), slope = flat ? d : -d;
    return chain(t, std::atan2(y.value, x.value), slope, -2 * t.value * d * slope);
  }
};

/// The same of several numbers, one after the other.
template <int Count, std::size_t Numbers>
void store(const std::array<HyperDual<Count>, Numbers>& all, double* r, double* ra, double* raa) {
  for (std::size_t k = 0; k < Numbers; ++k) all[k].store(r + k, ra + k * Count, raa + k * Count * Count);
}

/// The residual of a TranscribedProblem from a formula of `Count` numbers, written once for doubles and HyperDuals.
template <int Count, class Formula>
auto residualOf(Formula formula) {
  return [formula](const double* a, double* r, double* ra, double* raa) {
    if (ra == nullptr) {
      std::ranges::copy(formula(a), r);
      return;
    }
    std::array<HyperDual<Count>, Count> variables;
    for (int i = 0; i < Count; ++i) variables[i] = HyperDual<Count>::variable(i, a[i]);
    store(formula(variables), r, ra, raa);
  };
}

}  // namespace reachlab::predict
