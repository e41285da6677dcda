#pragma once
#include <array>
#include <span>
#include <vector>

#include "constraints/formula/expression.h"

namespace reachlab::constraints {

/// Bounds of an expression over a box of its variables (natural interval extension, Moore 1966). Not rounded outwards: used to find
/// places where a formula has no finite value, where a rounding more or less decides nothing.
struct Interval {
  double lo = 0, hi = 0;
};

/// The known properties of a node on a box. Touching: a root or an arc function reaches the end of its domain there (finite itself).
enum class Finiteness { Finite, Touching, Unknown, Nowhere };

/// One operation over intervals. `exponent` belongs to PowInt. A Constant, Variable or Parameter is `a` itself. Raises `finiteness` to what is
/// known of the result.
Interval applyOver(Op op, Interval a, Interval b, int exponent, Finiteness& finiteness);
Interval product(Interval a, Interval b);

class IntervalEvaluator {
 public:
  IntervalEvaluator(const ExpressionGraph& graph, std::span<const int> roots, const double* shape);
  /// Finiteness of each root on the box.
  const std::vector<Finiteness>& evaluate(const std::array<Interval, 2>& box);
  /// Bounds of root k on the box last evaluated.
  Interval rangeOf(std::size_t k) const { return bounds_[list_.roots[k]].range; }

 private:
  struct Bound {
    Interval range;
    Finiteness finiteness = Finiteness::Finite;
  };

  OperationList list_;
  std::vector<Bound> bounds_;
  std::vector<Finiteness> result_;
};

}  // namespace reachlab::constraints
