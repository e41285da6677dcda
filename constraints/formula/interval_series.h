#pragma once
#include <array>
#include <span>
#include <vector>

#include "constraints/formula/interval.h"

namespace reachlab::constraints {

/// Bounds of Taylor coefficients of expressions along a line u = u0 + u1 s, v = v0 + v1 s, for all u0, v0 of a box and all rates u1, v1 of
/// another (Moore 1966; Griewank and Walther, Evaluating Derivatives, ch. 13). abs and sign are bounded on both sides of their places, as if
/// each side ran on. An instance may be used by one thread at a time. Only the constructor allocates.
class IntervalSeries {
 public:
  static constexpr int kOrder = 8;
  IntervalSeries(const ExpressionGraph& graph, std::span<const int> roots, const double* shape);
  /// Bound of |(c_1, c_2, …)| over the roots, c being the coefficient of s^kOrder. Infinite where no bound is known.
  double bound(const std::array<Interval, 2>& box, const std::array<Interval, 2>& rate) noexcept;
  /// A bound from below of the same for s^1, over the box and the rates of the last call of bound().
  double leastSlope() const noexcept;

 private:
  using Series = std::array<Interval, kOrder + 1>;
  static void apply(const ExpressionNode& operation, const Series& a, const Series& b, Series& to) noexcept;

  OperationList list_;
  std::vector<Series> values_;
};

}  // namespace reachlab::constraints
