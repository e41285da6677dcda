#pragma once
#include <array>
#include <cmath>

namespace reachlab::predict {

/// A number with its first and second derivatives with respect to Count variables: exact Hessians of a formula written once.
template <int Count>
struct Jet {
  double value = 0;
  std::array<double, Count> slope{};
  std::array<double, Count * Count> bend{};  // row by row; only j <= i is kept up to date

  Jet() = default;
  Jet(double constant) : value(constant) {}  // implicit on purpose: a constant is a Jet
  static Jet variable(int index, double at) {
    Jet jet(at);
    jet.slope[index] = 1;
    return jet;
  }

  /// Value, slope and the whole of the bend to where the Newton matrix takes them from.
  void store(double* r, double* ra, double* raa) const {
    *r = value;
    for (int i = 0; i < Count; ++i) {
      ra[i] = slope[i];
      for (int j = 0; j <= i; ++j) raa[i * Count + j] = raa[j * Count + i] = bend[i * Count + j];
    }
  }

  /// f(x) with f, f', f'' at x.
  friend Jet chain(const Jet& x, double f, double f1, double f2) {
    Jet r(f);
    for (int i = 0; i < Count; ++i) r.slope[i] = f1 * x.slope[i];
    for (int i = 0; i < Count; ++i)
      for (int j = 0; j <= i; ++j) r.bend[i * Count + j] = f1 * x.bend[i * Count + j] + f2 * x.slope[i] * x.slope[j];
    return r;
  }
  friend Jet operator+(Jet a, const Jet& b) {
    a.value += b.value;
    for (int i = 0; i < Count; ++i) a.slope[i] += b.slope[i];
    for (int i = 0; i < Count; ++i)
      for (int j = 0; j <= i; ++j) a.bend[i * Count + j] += b.bend[i * Count + j];
    return a;
  }
  friend Jet operator-(const Jet& a) { return chain(a, -a.value, -1, 0); }
  friend Jet operator-(const Jet& a, const Jet& b) { return a + -b; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet r(a.value * b.value);
    for (int i = 0; i < Count; ++i) r.slope[i] = a.value * b.slope[i] + b.value * a.slope[i];
    for (int i = 0; i < Count; ++i)
      for (int j = 0; j < Count; ++j)
        r.bend[i * Count + j] =
            a.value * b.bend[i * Count + j] + b.value * a.bend[i * Count + j] + a.slope[i] * b.slope[j] + a.slope[j] * b.slope[i];
    return r;
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const double q = 1 / b.value;
    return a * chain(b, q, -q * q, 2 * q * q * q);
  }
  friend Jet sin(const Jet& a) { return chain(a, std::sin(a.value), std::cos(a.value), -std::sin(a.value)); }
  friend Jet cos(const Jet& a) { return chain(a, std::cos(a.value), -std::sin(a.value), -std::cos(a.value)); }
  friend Jet acos(const Jet& a) {
    const double s = 1 - a.value * a.value, root = std::sqrt(s);
    return chain(a, std::acos(a.value), -1 / root, -a.value / (s * root));
  }
  friend Jet atan2(const Jet& y, const Jet& x) {  // d = (x dy - y dx) / (x^2 + y^2): by the quotient that is smaller than one
    if (std::abs(y.value) <= std::abs(x.value)) {
      const Jet t = y / x;
      const double d = 1 / (1 + t.value * t.value);
      return chain(t, std::atan2(y.value, x.value), d, -2 * t.value * d * d);
    }
    const Jet t = x / y;
    const double d = 1 / (1 + t.value * t.value);
    return chain(t, std::atan2(y.value, x.value), -d, 2 * t.value * d * d);
  }
};

}  // namespace reachlab::predict
