#pragma once
#include <array>
#include <cmath>

/// Arithmetic of references: 113-bit numbers (34 decimal digits) with the two functions that the scenes need. It is separate from the
/// simulator, so that a reference shares no code with the results that it judges.
namespace reachlab::bench {

#ifdef __SIZEOF_FLOAT128__
using Quad = __float128;
#else
using Quad = long double;  // 113 bits where the compiler has no __float128 (AArch64)
#endif

template <class T>
struct SineCosine {
  T sine, cosine;
};

inline SineCosine<double> sineCosine(double x) { return {std::sin(x), std::cos(x)}; }

/// Reduces x by multiples of pi/2 (three doubles carry it to 1e-49) and sums the series. |x| < 1e6, error below 1e-33.
inline SineCosine<Quad> sineCosine(Quad x) {
  const double turns = std::nearbyint(static_cast<double>(x) / 1.5707963267948966);
  const Quad n = turns;
  const Quad r = ((x - n * Quad(1.5707963267948966)) - n * Quad(6.123233995736766e-17)) - n * Quad(-1.4973849048591833e-33);
  static const std::array<Quad, 34> inverseFactorial = [] {
    std::array<Quad, 34> f{};
    f[0] = 1;
    for (int i = 1; i < 34; ++i) f[i] = f[i - 1] / i;
    return f;
  }();
  const Quad r2 = r * r;
  Quad s = 0, c = 0;
  for (int i = 32; i >= 2; i -= 2) {
    s = inverseFactorial[i + 1] - r2 * s;
    c = inverseFactorial[i] - r2 * c;
  }
  // sin r = r (1 - r^2 (1/3! - r^2 (1/5! - ...))), cos r likewise
  const Quad sine = r * (1 - r2 * s), cosine = 1 - r2 * c;
  switch (static_cast<long long>(turns) & 3) {
    case 0: return {sine, cosine};
    case 1: return {cosine, -sine};
    case 2: return {-sine, -cosine};
    default: return {-cosine, sine};
  }
}

inline double absolute(double x) { return std::abs(x); }
inline Quad absolute(Quad x) { return x < 0 ? -x : x; }

/// Newton's method from the double's root. Two rounds reach 113 bits.
inline double squareRoot(double x) { return std::sqrt(x); }
inline Quad squareRoot(Quad x) {
  if (!(x > 0)) return 0;
  Quad y = std::sqrt(static_cast<double>(x));
  for (int i = 0; i < 3; ++i) y = (y + x / y) / 2;
  return y;
}

}  // namespace reachlab::bench
