#pragma once
#include <vector>

#include "constraints/formula/expression.h"
#include "constraints/regularity/places.h"

namespace reachlab::constraints {

/// A stretch of a curve: the nodes of its formula in `graph` (x, y and z), and the curve that evaluates them.
struct CurveStretch {
  std::vector<int> r;
  Curve curve;
  double lo = 0, hi = 0;
};

/// Places of a stretch where r_phi vanishes, at most `most`: cusps, folds and standstills. `boxes` as of findRoots. Adds nodes.
std::vector<Place> findStillPlaces(ExpressionGraph& graph, const double* shape, const CurveStretch& stretch, int& boxes, std::size_t most);

/// The pieces, with short stretches cut out on which the curve bends much more than elsewhere. Such a stretch is shorter than the distance
/// of one tick. It becomes a separate piece, so that a step ends on its boundary and crosses it in small parts. The search covers phi =
/// `from` to `to`, and the usual bend is taken from a turn about `about`. `formulas` holds r of each piece. The pieces are returned
/// unchanged if there is no such stretch, or if there are too many. Adds nodes.
std::vector<CurvePiece> cutAtNarrow(ExpressionGraph& graph, const double* shape, const std::vector<CurvePiece>& pieces,
                                    const std::vector<std::vector<int>>& formulas, double from, double to, double about);

}  // namespace reachlab::constraints
