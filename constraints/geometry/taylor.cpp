#include "constraints/geometry/taylor.h"

#include <cmath>

#include "base/math/elementary.h"

namespace reachlab::constraints {
namespace {

constexpr int kCount = Taylor::kMaxDegree + 1;
using Series = std::array<double, kCount>;  // Taylor coefficients of a function of one variable

Taylor constantOf(double value) {
  Taylor t;
  t.c[0] = value;
  return t;
}

Taylor scaled(const Taylor& x, double factor) {
  Taylor t;
  for (int i = 0; i < Taylor::kTerms; ++i) t.c[i] = factor * x.c[i];
  return t;
}

Taylor sum(const Taylor& x, const Taylor& y, double sign) {
  Taylor t;
  for (int i = 0; i < Taylor::kTerms; ++i) t.c[i] = x.c[i] + sign * y.c[i];
  return t;
}

bool isConstant(const Taylor& x) {
  for (int i = 1; i < Taylor::kTerms; ++i)
    if (x.c[i] != 0) return false;
  return true;
}

// f(x) from the Taylor coefficients of f about the constant term of x, by Horner's scheme.
Taylor compose(const Series& f, const Taylor& x, int degree) {
  if (isConstant(x)) return constantOf(f[0]);  // whatever its derivatives are
  Taylor change = x;
  change.c[0] = 0;
  Taylor t = constantOf(f[degree]);
  for (int k = degree; k-- > 0;) {
    t = multiply(t, change, degree);
    t.c[0] += f[k];
  }
  return t;
}

// The p-th power of a series that does not begin with 0, from w t' = p w' t (Knuth, The Art of Computer Programming, 4.7).
Series powerOf(const Series& w, double p) {
  Series t{};
  t[0] = elementary::pow(w[0], p);
  for (int k = 1; k < kCount; ++k) {
    for (int i = 1; i <= k; ++i) t[k] += (p * i - (k - i)) * w[i] * t[k - i];
    t[k] /= k * w[0];
  }
  return t;
}

// The integral of a series, from `start` on.
Series integralOf(const Series& rate, double start, double factor) {
  Series t{start};
  for (int k = 1; k < kCount; ++k) t[k] = factor * rate[k - 1] / k;
  return t;
}

// f with f' = a + b f^2.
Series riccati(double start, double a, double b) {
  Series t{start};
  for (int k = 0; k + 1 < kCount; ++k) {
    double square = 0;
    for (int i = 0; i <= k; ++i) square += t[i] * t[k - i];
    t[k + 1] = ((k == 0 ? a : 0) + b * square) / (k + 1);
  }
  return t;
}

// f with derivatives f, g, s f, s g … (circular functions: s = -1, hyperbolic ones: s = 1).
Series alternating(double f, double g, double s) {
  Series t{};
  double factorial = 1;
  for (int k = 0; k < kCount; ++k) {
    if (k > 0) factorial *= k;
    t[k] = (k % 2 ? g : f) / factorial;
    if (k % 2) f *= s, g *= s;
  }
  return t;
}

// (x0 + d)^p: of a whole p >= 0 the series ends, also at x0 = 0.
Series binomial(double x0, double p) {
  Series t{};
  double choose = 1;
  for (int k = 0; k < kCount && choose != 0; choose *= (p - k) / (k + 1.0), ++k) t[k] = choose * elementary::pow(x0, p - k);
  return t;
}

Taylor quotient(const Taylor& x, const Taylor& y, int degree) {
  return isConstant(y) ? scaled(x, 1 / y.c[0]) : multiply(x, compose(powerOf({y.c[0], 1}, -1), y, degree), degree);
}

// The angle turned from the direction (x0, y0), whose tangent has no branch.
Taylor angleOf(const Taylor& y, const Taylor& x, int degree) {
  const double x0 = x.c[0], y0 = y.c[0];
  const Taylor across = sum(scaled(y, x0), scaled(x, y0), -1), along = sum(scaled(x, x0), scaled(y, y0), 1);
  Taylor t = compose(integralOf(powerOf({1, 0, 1}, -1), 0, 1), quotient(across, along, degree), degree);
  t.c[0] = elementary::atan2(y0, x0);
  return t;
}

Taylor raise(const Taylor& x, const Taylor& y, int degree) {
  if (isConstant(y)) return compose(binomial(x.c[0], y.c[0]), x, degree);
  const Taylor logarithm = apply(Op::Log, x, x, 0, degree);
  return apply(Op::Exp, multiply(y, logarithm, degree), x, 0, degree);
}

Series seriesOf(Op op, double x) {
  switch (op) {
    case Op::Sin: return alternating(elementary::sin(x), elementary::cos(x), -1);
    case Op::Cos: return alternating(elementary::cos(x), -elementary::sin(x), -1);
    case Op::Sinh: return alternating(elementary::sinh(x), elementary::cosh(x), 1);
    case Op::Cosh: return alternating(elementary::cosh(x), elementary::sinh(x), 1);
    case Op::Exp: return alternating(elementary::exp(x), elementary::exp(x), 1);
    case Op::Tan: return riccati(elementary::tan(x), 1, 1);
    case Op::Tanh: return riccati(elementary::tanh(x), 1, -1);
    case Op::Asin: return integralOf(powerOf({1 - x * x, -2 * x, -1}, -0.5), elementary::asin(x), 1);
    case Op::Acos: return integralOf(powerOf({1 - x * x, -2 * x, -1}, -0.5), elementary::acos(x), -1);
    case Op::Atan: return integralOf(powerOf({1 + x * x, 2 * x, 1}, -1), elementary::atan(x), 1);
    case Op::Log: return integralOf(powerOf({x, 1}, -1), elementary::log(x), 1);
    case Op::Sqrt: return powerOf({x, 1}, 0.5);
    default: return {};
  }
}

}  // namespace

Taylor multiply(const Taylor& x, const Taylor& y, int degree) {
  Taylor t;
  for (int d = 0; d <= degree; ++d)
    for (int e = 0; d + e <= degree; ++e) {
      const double *p = &x.c[d * (d + 1) / 2], *q = &y.c[e * (e + 1) / 2];
      double* to = &t.c[(d + e) * (d + e + 1) / 2];
      for (int i = 0; i <= d; ++i) {
        if (p[i] == 0) continue;  // most polynomials have few terms
        for (int j = 0; j <= e; ++j) to[i + j] += p[i] * q[j];
      }
    }
  return t;
}

Taylor apply(Op op, const Taylor& x, const Taylor& y, int exponent, int degree) {
  const double sign = x.c[0] > 0 ? 1 : x.c[0] < 0 ? -1 : x.c[0];
  switch (op) {
    case Op::Add: return sum(x, y, 1);
    case Op::Sub: return sum(x, y, -1);
    case Op::Mul: return multiply(x, y, degree);
    case Op::Div: return quotient(x, y, degree);
    case Op::Neg: return scaled(x, -1);
    case Op::PowInt: return compose(binomial(x.c[0], exponent), x, degree);
    case Op::Pow: return raise(x, y, degree);
    case Op::Atan2: return angleOf(x, y, degree);
    case Op::Abs: return scaled(x, sign);
    case Op::Sign: return constantOf(sign);
    default: return compose(seriesOf(op, x.c[0]), x, degree);
  }
}

}  // namespace reachlab::constraints
