#include "constraints/formula/interval_series.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reachlab::constraints {
namespace {

constexpr int kCount = IntervalSeries::kOrder + 1;
using Series = std::array<Interval, kCount>;

constexpr Interval kUnbounded{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

Interval operator+(Interval a, Interval b) { return {a.lo + b.lo, a.hi + b.hi}; }
Interval operator-(Interval a, Interval b) { return {a.lo - b.hi, a.hi - b.lo}; }
Interval operator*(double factor, Interval a) {
  return factor < 0 ? Interval{factor * a.hi, factor * a.lo} : Interval{factor * a.lo, factor * a.hi};
}
Interval hull(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }
/// Everything if the divisor holds 0.
Interval quotient(Interval a, Interval b) { return b.lo > 0 || b.hi < 0 ? product(a, {1 / b.hi, 1 / b.lo}) : kUnbounded; }
Interval over(Op op, Interval a, Interval b = {}, int exponent = 0) {
  Finiteness none = Finiteness::Finite;
  return applyOver(op, a, b, exponent, none);
}
Interval square(Interval a) { return over(Op::PowInt, a, {}, 2); }

/// Coefficient k of x y, with the terms from x_first y_(k-first) to x_last y_(k-last).
Interval convolve(const Series& x, const Series& y, int k, int first, int last) {
  Interval sum;
  for (int i = first; i <= last; ++i) sum = sum + product(x[i], y[k - i]);
  return sum;
}
Series multiply(const Series& x, const Series& y) {
  Series t;
  for (int k = 0; k < kCount; ++k) t[k] = convolve(x, y, k, 0, k);
  return t;
}
Series squareOf(const Series& x) {
  Series t;
  for (int k = 0; k < kCount; ++k) {
    t[k] = 2 * convolve(x, x, k, 0, (k - 1) / 2 - (k == 0 ? 1 : 0));
    if (k % 2 == 0) t[k] = t[k] + square(x[k / 2]);
  }
  return t;
}
Series divide(const Series& x, const Series& y) {
  Series t;
  for (int k = 0; k < kCount; ++k) t[k] = quotient(x[k] - convolve(y, t, k, 1, k), y[0]);
  return t;
}
Series constantOf(Interval value) {
  Series t{};
  t[0] = value;
  return t;
}
Series negative(const Series& x) {
  Series t;
  for (int k = 0; k < kCount; ++k) t[k] = -1 * x[k];
  return t;
}

/// i a_i: the coefficients of s a'.
Series slopesOf(const Series& a) {
  Series t;
  for (int k = 0; k < kCount; ++k) t[k] = k * a[k];
  return t;
}

/// f with f' = w a', begun with f_0. `next` makes w_k from f_0 … f_k, before f_(k+1) is asked for.
template <class Next>
Series integrate(const Series& a, Interval begin, const Next& next) {
  const Series slopes = slopesOf(a);
  Series f{}, w{};
  f[0] = begin;
  w[0] = next(f, w, 0);
  for (int k = 1; k < kCount; ++k) {
    f[k] = (1.0 / k) * convolve(slopes, w, k, 1, k);
    w[k] = next(f, w, k);
  }
  return f;
}
/// f with s f' = r / w for the parameter s, begun with f_0. `rate` makes r_k from f_0 … f_(k-1).
template <class Rate>
Series integrateOver(Interval begin, const Series& w, const Rate& rate) {
  Series f{}, slopes{};  // slopes: of f
  f[0] = begin;
  for (int k = 1; k < kCount; ++k) {
    slopes[k] = quotient(rate(f, k) - convolve(slopes, w, k, 1, k - 1), w[0]);
    f[k] = (1.0 / k) * slopes[k];
  }
  return f;
}
/// f with f' = a' / w.
Series integrateOver(const Series& a, Interval begin, const Series& w) {
  return integrateOver(begin, w, [&](const Series&, int k) { return k * a[k]; });
}

Series exponentialOf(const Series& a) {
  return integrate(a, over(Op::Exp, a[0]), [](const Series& f, const Series&, int k) { return f[k]; });
}
/// Sine and cosine (sign = -1), or the hyperbolic ones (1): `f` and its fellow `g` with f' = g a', g' = sign f a'.
Series waveOf(const Series& a, Interval first, Interval other, double signOfFirst, double signOfOther) {
  const Series slopes = slopesOf(a);
  Series f{}, g{};
  f[0] = first;
  g[0] = other;
  for (int k = 1; k < kCount; ++k) {
    f[k] = (signOfFirst / k) * convolve(slopes, g, k, 1, k);
    g[k] = (signOfOther / k) * convolve(slopes, f, k, 1, k);
  }
  return f;
}
/// tan (sign = 1) or tanh (-1): f' = (1 + sign f^2) a', with 1 + sign f^2 given at the beginning.
Series tangentOf(const Series& a, Interval begin, Interval slope, double sign) {
  return integrate(a, begin, [&](const Series& f, const Series&, int k) { return k == 0 ? slope : sign * convolve(f, f, k, 0, k); });
}
Series rootOf(const Series& a) {
  Series t{};
  t[0] = over(Op::Sqrt, a[0]);
  const Interval twice = 2 * t[0];
  for (int k = 1; k < kCount; ++k) t[k] = quotient(a[k] - convolve(t, t, k, 1, k - 1), twice);
  return t;
}
Series logarithmOf(const Series& a) { return integrateOver(a, a[0].lo > 0 ? over(Op::Log, a[0]) : kUnbounded, a); }
Series wholePowerOf(const Series& a, int exponent) {
  const int count = std::abs(exponent);
  if (count == 0) return constantOf({1, 1});
  Series t = constantOf({1, 1}), factor = a;
  bool begun = false;
  for (int rest = count; rest > 0; rest /= 2) {
    if (rest % 2 != 0) {
      t = begun ? multiply(t, factor) : factor;
      begun = true;
    }
    if (rest > 1) factor = squareOf(factor);
  }
  t[0] = over(Op::PowInt, a[0], {}, count);
  return exponent > 0 ? t : divide(constantOf({1, 1}), t);
}
Series powerOf(const Series& a, const Series& b) {
  const bool fixed = std::all_of(b.begin() + 1, b.end(), [](Interval c) { return c.lo == 0 && c.hi == 0; }) && b[0].lo == b[0].hi;
  const double p = b[0].lo;
  if (fixed && p == std::floor(p) && std::abs(p) <= 64) return wholePowerOf(a, static_cast<int>(p));
  const Interval first = over(Op::Pow, a[0], b[0]);
  if (fixed) {  // a t' = p a' t
    const Series slopes = slopesOf(a);
    return integrateOver(first, a, [&](const Series& t, int k) { return p * convolve(slopes, t, k, 1, k); });
  }
  Series t = exponentialOf(multiply(b, logarithmOf(a)));
  t[0] = first;
  return t;
}
/// The angle of (x, y): (x y' - y x') / (x^2 + y^2).
Series angleOf(const Series& y, const Series& x) {
  const Series dy = slopesOf(y), dx = slopesOf(x), xx = squareOf(x), yy = squareOf(y);
  Series w;
  for (int k = 0; k < kCount; ++k) w[k] = xx[k] + yy[k];
  return integrateOver(over(Op::Atan2, y[0], x[0]), w,
                       [&](const Series&, int k) { return convolve(dy, x, k, 1, k) - convolve(dx, y, k, 1, k); });
}
/// 1 + sign a^2.
Series oneAnd(double sign, const Series& a) {
  Series w = squareOf(a);
  for (Interval& c : w) c = sign * c;
  w[0] = w[0] + Interval{1, 1};
  return w;
}
Series magnitudeOf(const Series& a) {
  if (a[0].lo > 0) return a;
  if (a[0].hi < 0) return negative(a);
  Series t;
  for (int k = 0; k < kCount; ++k) t[k] = hull(a[k], -1 * a[k]);
  t[0] = over(Op::Abs, a[0]);
  return t;
}

}  // namespace

IntervalSeries::IntervalSeries(const ExpressionGraph& graph, std::span<const int> roots, const double* shape)
    : list_(graph.operationsFor(roots, shape)), values_(list_.operations.size()) {}

void IntervalSeries::apply(const ExpressionNode& operation, const Series& a, const Series& b, Series& to) noexcept {
  const Interval first = over(operation.op, a[0], b[0], operation.b);
  switch (operation.op) {
    case Op::Add:
      for (int k = 0; k < kCount; ++k) to[k] = a[k] + b[k];
      break;
    case Op::Sub:
      for (int k = 0; k < kCount; ++k) to[k] = a[k] - b[k];
      break;
    case Op::Neg: to = negative(a); break;
    case Op::Mul: to = &a == &b ? squareOf(a) : multiply(a, b); break;
    case Op::Div: to = divide(a, b); break;
    case Op::PowInt: to = wholePowerOf(a, operation.b); break;
    case Op::Pow: to = powerOf(a, b); break;
    case Op::Sin: to = waveOf(a, first, over(Op::Cos, a[0]), 1, -1); break;
    case Op::Cos: to = waveOf(a, first, over(Op::Sin, a[0]), -1, 1); break;
    case Op::Sinh: to = waveOf(a, first, over(Op::Cosh, a[0]), 1, 1); break;
    case Op::Cosh: to = waveOf(a, first, over(Op::Sinh, a[0]), 1, 1); break;
    case Op::Tan: to = tangentOf(a, first, quotient({1, 1}, square(over(Op::Cos, a[0]))), 1); break;
    case Op::Tanh: to = tangentOf(a, first, quotient({1, 1}, square(over(Op::Cosh, a[0]))), -1); break;
    case Op::Exp: to = exponentialOf(a); break;
    case Op::Log: to = logarithmOf(a); break;
    case Op::Sqrt: to = rootOf(a); break;
    case Op::Asin: to = integrateOver(a, first, rootOf(oneAnd(-1, a))); break;
    case Op::Acos: to = integrateOver(negative(a), first, rootOf(oneAnd(-1, a))); break;
    case Op::Atan: to = integrateOver(a, first, oneAnd(1, a)); break;
    case Op::Atan2: to = angleOf(a, b); break;
    case Op::Abs: to = magnitudeOf(a); break;
    case Op::Sign: to = constantOf(first); break;
    case Op::Constant:
    case Op::Variable:
    case Op::Parameter: break;
  }
}

double IntervalSeries::bound(const std::array<Interval, 2>& box, const std::array<Interval, 2>& rate) noexcept {
  static constexpr Series kNothing{};
  for (std::size_t i = 0; i < list_.operations.size(); ++i) {
    const ExpressionNode& operation = list_.operations[i];
    Series& to = values_[i];
    if (operation.op == Op::Constant) {
      to = constantOf({operation.value, operation.value});
    } else if (operation.op == Op::Variable) {
      to = constantOf(box[operation.a]);
      to[1] = rate[operation.a];
    } else {
      const bool two = operandCount(operation.op) == 2;
      apply(operation, values_[operation.a], two ? values_[operation.b] : kNothing, to);
    }
  }
  double squares = 0, largest = 0;  // the squares are of shares of the largest, so that they do not overflow
  for (const int root : list_.roots) {
    const Interval& last = values_[root][kOrder];
    const double most = std::max(std::abs(last.lo), std::abs(last.hi));
    if (!(most < std::numeric_limits<double>::infinity())) return std::numeric_limits<double>::infinity();
    if (most > largest) {
      squares = squares * (largest / most) * (largest / most) + 1;
      largest = most;
    } else if (largest > 0) {
      squares += (most / largest) * (most / largest);
    }
  }
  return largest * std::sqrt(squares);
}

double IntervalSeries::leastSlope() const noexcept {
  double least = 0;
  for (const int root : list_.roots) {
    const Interval& slope = values_[root][1];
    least = std::max({least, slope.lo, -slope.hi});
  }
  return std::isfinite(least) ? least : 0;
}

}  // namespace reachlab::constraints
