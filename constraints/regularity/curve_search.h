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

struct NarrowSearch {
  std::vector<NarrowPlace> places;  // in order
  double lo = 0, hi = 0;            // all of them between these are known
};
/// The places where a curve turns within less than the way of a tick, by interval arithmetic on Taylor series: from `about` outwards through
/// `window`, and beyond it where a single look shows that there are no such places. `formulas` holds r of each piece. `period` is that of the whole
/// formula, or 0. Beside the places of `blind`, where the formula has a limit and no value or is about to end, nothing is looked for.
NarrowSearch findNarrowPlaces(const ExpressionGraph& graph, const double* shape, const std::vector<CurvePiece>& pieces,
                              const std::vector<std::vector<int>>& formulas, const std::vector<double>& blind, const Domain& window,
                              double about, double period);

}  // namespace reachlab::constraints
