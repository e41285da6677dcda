#pragma once
#include <cmath>

namespace reachlab::predict {

/// An unevaluated sum hi + lo of two doubles, about 32 significant digits (Dekker 1971). The error-free sums are Knuth's, and the
/// error-free products use the fused multiply-add. For the few predictions whose conditioning needs more than a double. Any thread.
struct DoubleDouble {
  double hi = 0, lo = 0;

  DoubleDouble() = default;
  DoubleDouble(double value) : hi(value) {}  // implicit on purpose: a double is one
  DoubleDouble(double high, double low) : hi(high), lo(low) {}
  explicit operator double() const { return hi + lo; }

  static DoubleDouble ofSum(double a, double b) {
    const double s = a + b, t = s - a;
    return {s, (a - (s - t)) + (b - t)};
  }
  static DoubleDouble ofOrderedSum(double a, double b) {  // |a| >= |b|
    const double s = a + b;
    return {s, b - (s - a)};
  }

  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = ofSum(a.hi, b.hi), low = ofSum(a.lo, b.lo);
    const DoubleDouble middle = ofOrderedSum(high.hi, high.lo + low.hi);
    return ofOrderedSum(middle.hi, middle.lo + low.lo);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const double p = a.hi * b.hi;
    return ofOrderedSum(p, std::fma(a.hi, b.hi, -p) + (a.hi * b.lo + a.lo * b.hi));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double q1 = a.hi / b.hi;
    const DoubleDouble r1 = a - b * q1;
    const double q2 = r1.hi / b.hi;
    const DoubleDouble r2 = r1 - b * q2;
    return ofOrderedSum(q1, q2) + r2.hi / b.hi;
  }
  DoubleDouble& operator+=(const DoubleDouble& o) { return *this = *this + o; }
  DoubleDouble& operator-=(const DoubleDouble& o) { return *this = *this - o; }
  DoubleDouble& operator*=(const DoubleDouble& o) { return *this = *this * o; }
  DoubleDouble& operator/=(const DoubleDouble& o) { return *this = *this / o; }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) { return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo); }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
};

inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (!(a.hi > 0)) return 0.0;
  const double root = std::sqrt(a.hi);
  const DoubleDouble rest = a - DoubleDouble(root) * root;
  return DoubleDouble(root) + rest.hi / (2 * root);
}

}  // namespace reachlab::predict
