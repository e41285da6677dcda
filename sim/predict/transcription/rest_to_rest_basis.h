#pragma once
#include <cstddef>
#include <vector>

#include "base/math/legendre_series.h"

namespace reachlab::predict {

/// Motions y from rest to rest on x in [-1, 1] with derivatives 1 … order-1 zero at both ends:
/// y^(order) = g P_(order-1) + sum_k c_k sqrt(2n+1) P_n, n = order + k.
/// The first column runs from 0 to 1 and the others from 0 to 0, so that the ends hold for any c. The highest derivative is an orthonormal
/// expansion. See docs/theory/methods.md, "Predictions: transcription": [s(1-s)]^order times polynomials, in its best basis.
class RestToRestBasis {
 public:
  RestToRestBasis(int order, int unknowns);
  int order() const { return order_; }
  int columns() const { return static_cast<int>(series_.size()); }
  /// d^m y / dx^m of one column, 0 <= m <= order.
  const LegendreSeries& derivative(int column, int m) const { return series_[column][m]; }
  /// All derivatives of all columns at one x, times rate^m: table[column * (order+1) + m].
  void tabulate(double x, double rate, double* table) const;
  /// A derivative of a combination: coefficient of the first column, then the unknowns.
  LegendreSeries combine(const std::vector<double>& coefficient, int m) const;

 private:
  // Integrating a polynomial P_n k times leaves P_(n-k) … P_(n+k): the terms before are zero.
  std::size_t firstTerm(int column, int m) const { return static_cast<std::size_t>(column + m > 1 ? column + m - 1 : 0); }

  int order_;
  std::vector<std::vector<LegendreSeries>> series_;
};

}  // namespace reachlab::predict
