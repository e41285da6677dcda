#pragma once
#include <type_traits>

#include "base/math/lanes.h"
#include "sim/predict/numerics/double_double.h"

namespace reachlab::predict {

/// Eight DoubleDoubles. Sums may leave lo as large as the rounding of the terms. settle() makes it small again.
struct WideBatch {
  LaneBatch hi, lo;
};

template <class Real>
using BatchOf = std::conditional_t<std::is_same_v<Real, double>, LaneBatch, WideBatch>;

/// A number's first 16 digits.
inline double leading(double x) { return x; }
inline double leading(const DoubleDouble& x) { return x.hi; }
inline LaneBatch leading(const LaneBatch& x) { return x; }
inline LaneBatch leading(const WideBatch& x) { return x.hi; }

inline double laneOf(const LaneBatch& x, int lane) { return x[lane]; }
inline DoubleDouble laneOf(const WideBatch& x, int lane) { return {x.hi[lane], x.lo[lane]}; }
inline void setLane(LaneBatch& x, int lane, double value) { x[lane] = value; }
inline void setLane(WideBatch& x, int lane, const DoubleDouble& value) { x.hi[lane] = value.hi, x.lo[lane] = value.lo; }

inline void settle(LaneBatch&) {}
inline void settle(WideBatch& x) {
  const LaneBatch sum = x.hi + x.lo;
  x.lo -= sum - x.hi;
  x.hi = sum;
}

/// sum += a x.
inline void addProduct(LaneBatch& sum, double a, const LaneBatch& x) { sum = mulAdd(a, x, sum); }
/// The rounding of a product by the fused multiply-add, of a sum after Knuth.
inline void addProduct(WideBatch& sum, const WideBatch& a, const WideBatch& x) {
  const LaneBatch p = a.hi * x.hi, rounding = mulAdd(a.hi, x.hi, LaneBatch(-p));
  const LaneBatch s = sum.hi + p, t = s - sum.hi;
  sum.lo += ((sum.hi - (s - t)) + (p - t)) + (rounding + (a.hi * x.lo + a.lo * x.hi));
  sum.hi = s;
}
inline void addProduct(WideBatch& sum, const DoubleDouble& a, const WideBatch& x) {
  addProduct(sum, WideBatch{a.hi - LaneBatch{}, a.lo - LaneBatch{}}, x);
}

}  // namespace reachlab::predict
