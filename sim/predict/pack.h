#pragma once
#include <cmath>

#include "sim/predict/double_double.h"

namespace reachlab::predict {

/// Eight numbers that are computed side by side: the same step of eight panels, or of eight columns. In place and by reference, so
/// that the vector type crosses no function's interface by value.
inline constexpr int kPack = 8;
using Pack = double __attribute__((vector_size(kPack * sizeof(double))));

/// Eight DoubleDoubles. Sums may leave lo as large as the terms' rounding; settle() makes it small again.
struct WidePack {
  Pack hi, lo;
};

template <class Real>
struct PackOf {
  using Type = Pack;
};
template <>
struct PackOf<DoubleDouble> {
  using Type = WidePack;
};

inline void setLane(Pack& x, int lane, double value) { x[lane] = value; }
inline void setLane(WidePack& x, int lane, const DoubleDouble& value) { x.hi[lane] = value.hi, x.lo[lane] = value.lo; }
inline double laneOf(const Pack& x, int lane) { return x[lane]; }
inline DoubleDouble laneOf(const WidePack& x, int lane) { return {x.hi[lane], x.lo[lane]}; }
inline const Pack& nearest(const Pack& x) { return x; }
inline const Pack& nearest(const WidePack& x) { return x.hi; }

inline void settle(Pack&) {}
inline void settle(WidePack& x) {
  const Pack sum = x.hi + x.lo;
  x.lo -= sum - x.hi;
  x.hi = sum;
}

// sum += p + rest with an error-free sum (Knuth's) of the high parts.
inline void addWide(WidePack& sum, const Pack& p, const Pack& rest) {
  const Pack s = sum.hi + p, t = s - sum.hi;
  sum.lo += ((sum.hi - (s - t)) + (p - t)) + rest;
  sum.hi = s;
}

// The rounding of p = a x, exactly. Whole vectors in, so that the compiler makes one instruction of the loop.
inline void findRounding(const Pack& a, const Pack& x, const Pack& p, Pack& rounding) {
  const Pack minus = -p;
  for (int i = 0; i < kPack; ++i) rounding[i] = std::fma(a[i], x[i], minus[i]);
}

/// sum += a x.
inline void addProduct(Pack& sum, double a, const Pack& x) { sum += a * x; }
inline void addProduct(Pack& sum, const Pack& a, const Pack& x) { sum += a * x; }
inline void addProduct(WidePack& sum, const WidePack& a, const WidePack& x) {
  const Pack p = a.hi * x.hi;
  Pack rounding;
  findRounding(a.hi, x.hi, p, rounding);
  addWide(sum, p, rounding + (a.hi * x.lo + a.lo * x.hi));
}
inline void addProduct(WidePack& sum, const DoubleDouble& a, const WidePack& x) {
  addProduct(sum, WidePack{a.hi - Pack{}, a.lo - Pack{}}, x);
}
inline void addProduct(WidePack& sum, const DoubleDouble& a, const Pack& x) {
  const Pack high = a.hi - Pack{}, p = high * x;
  Pack rounding;
  findRounding(high, x, p, rounding);
  addWide(sum, p, rounding + a.lo * x);
}

}  // namespace reachlab::predict
