#pragma once
#include <cmath>

#include "sim/predict/numerics/double_double.h"

namespace reachlab::predict {

/// Eight numbers that are computed side by side. In place and by reference, so that the vector type crosses no function's interface
/// by value.
inline constexpr int kLanes = 8;
using LaneBatch = double __attribute__((vector_size(kLanes * sizeof(double))));

/// Eight DoubleDoubles. Sums may leave lo as large as the terms' rounding; settle() makes it small again.
struct WideBatch {
  LaneBatch hi, lo;
};

inline DoubleDouble laneOf(const WideBatch& x, int lane) { return {x.hi[lane], x.lo[lane]}; }
inline void setLane(WideBatch& x, int lane, const DoubleDouble& value) { x.hi[lane] = value.hi, x.lo[lane] = value.lo; }

inline void settle(WideBatch& x) {
  const LaneBatch sum = x.hi + x.lo;
  x.lo -= sum - x.hi;
  x.hi = sum;
}

/// sum += a x. The rounding of a product by the fused multiply-add, of a sum after Knuth.
inline void addProduct(WideBatch& sum, const WideBatch& a, const WideBatch& x) {
  const LaneBatch p = a.hi * x.hi, minus = -p;
  LaneBatch rounding;
  for (int i = 0; i < kLanes; ++i) rounding[i] = std::fma(a.hi[i], x.hi[i], minus[i]);  // one instruction for the whole vector
  const LaneBatch s = sum.hi + p, t = s - sum.hi;
  sum.lo += ((sum.hi - (s - t)) + (p - t)) + (rounding + (a.hi * x.lo + a.lo * x.hi));
  sum.hi = s;
}
inline void addProduct(WideBatch& sum, const DoubleDouble& a, const WideBatch& x) {
  addProduct(sum, WideBatch{a.hi - LaneBatch{}, a.lo - LaneBatch{}}, x);
}

}  // namespace reachlab::predict
