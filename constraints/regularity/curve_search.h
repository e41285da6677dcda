#pragma once
#include <vector>

#include "constraints/formula/expression.h"
#include "constraints/regularity/places.h"

namespace reachlab::constraints {

/// A stretch of a curve: its formula's nodes, x, y and z, in `graph`, and what evaluates them.
struct CurveStretch {
  std::vector<int> r;
  Curve curve;
  double lo = 0, hi = 0;
};

/// Places of a stretch where r_phi vanishes, at most `most`: cusps, folds and standstills. `boxes` as of findRoots. Adds nodes.
std::vector<Place> findStillPlaces(ExpressionGraph& graph, const double* shape, const CurveStretch& stretch, int& boxes, std::size_t most);

/// The pieces, cut at stretches on which the curve bends much more than elsewhere and that are shorter than a tick's way: pieces of their
/// own, so that a step lands on them and goes through in small parts. Looks from phi = `from` to `to`, and takes what is usual from a turn
/// about `about`. `formulas`: r of each piece. The pieces as they were where there is no such stretch, or too many. Adds nodes.
std::vector<CurvePiece> cutAtNarrow(ExpressionGraph& graph, const double* shape, const std::vector<CurvePiece>& pieces,
                                    const std::vector<std::vector<int>>& formulas, double from, double to, double about);

}  // namespace reachlab::constraints
