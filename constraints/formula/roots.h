#pragma once
#include <vector>

#include "constraints/formula/expression.h"

namespace reachlab::constraints {

/// Where one expression in phi (or another variable) vanishes in [lo, hi].
struct RootSearch {
  std::vector<double> roots;  // in order; a root that could not be told from its neighbours stands once
  double examinedTo = 0;      // from lo up to here none is missing; hi unless the work grew too large
};

/// All roots by interval bisection (Moore 1966). A stretch whose bounds exclude 0 has no root. A stretch on which the derivative keeps its
/// sign has at most one root. Any other stretch is halved, down to 1e-13 of its position. `expression` must be smooth in (lo, hi). Roots
/// nearer to each other than `apart` (of |phi|, at least 1) count as a single root. Adds the derivative to the graph. `other` is the value
/// of the other variable. `boxes` is the number of stretches that may still be examined, and it is counted down.
RootSearch findRoots(ExpressionGraph& graph, int expression, const double* shape, double lo, double hi, int& boxes, double apart = 1e-12,
                     int variable = 0, double other = 0);

}  // namespace reachlab::constraints
