#pragma once
#include <cstdint>

namespace reachlab::bench {

using V8 = double __attribute__((vector_size(64)));
using I8 = std::int64_t __attribute__((vector_size(64)));

/// Bits of T as integers, for one double or eight.
template <class T>
struct Lanes {
  using Integer = std::int64_t;
  static Integer bits(double x) { return __builtin_bit_cast(std::int64_t, x); }
  static double select(bool yes, double a, double b) { return yes ? a : b; }
};
template <>
struct Lanes<V8> {
  using Integer = I8;
  static I8 bits(V8 x) { return __builtin_bit_cast(I8, x); }
  static V8 select(I8 yes, V8 a, V8 b) { return yes ? a : b; }
};

/// sin and cos inlined, |x| < 1e5, error below 1e-16 relative to 1: reduction by pi/2 in two parts, then the series.
template <class T>
inline void sinCos(T x, T& sine, T& cosine) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer, whose low bits it then holds
  const T shifted = x * 0.6366197723675814 + kRound;
  const auto quadrant = Lanes<T>::bits(shifted);
  const T n = shifted - kRound;
  const T r = (x - n * 1.5707963267341256) - n * 6.077100506506192e-11;
  const T r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const T s = ((-1.0 / 6 + r2 * (1.0 / 120)) + r4 * (-1.0 / 5040 + r2 * (1.0 / 362880))) +
              r8 * ((-1.0 / 39916800 + r2 * (1.0 / 6227020800)) + r4 * (-1.0 / 1307674368000 + r2 * (1.0 / 355687428096000)));
  const T c = ((-0.5 + r2 * (1.0 / 24)) + r4 * (-1.0 / 720 + r2 * (1.0 / 40320))) +
              r8 * ((-1.0 / 3628800 + r2 * (1.0 / 479001600)) + r4 * (-1.0 / 87178291200 + r2 * (1.0 / 20922789888000)));
  const T sinR = r + r * r2 * s, cosR = 1 + r2 * c;
  const auto odd = (quadrant & 1) != 0;
  const T a = Lanes<T>::select(odd, cosR, sinR), b = Lanes<T>::select(odd, sinR, cosR);
  sine = Lanes<T>::select((quadrant & 2) != 0, -a, a);
  cosine = Lanes<T>::select(((quadrant + 1) & 2) != 0, -b, b);
}

}  // namespace reachlab::bench
