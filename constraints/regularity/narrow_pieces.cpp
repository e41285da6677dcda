#include <algorithm>
#include <cmath>
#include <numbers>

#include "constraints/formula/formula.h"
#include "constraints/formula/roots.h"
#include "constraints/regularity/branch_curve.h"
#include "constraints/regularity/curve_search.h"
#include "constraints/regularity/narrow.h"

namespace reachlab::constraints {
namespace {

constexpr std::size_t kMost = 64;  // narrow stretches: of a formula with more, none is cut
constexpr int kSamplesOfTurn = 257;      // of a turn, for what is usual
constexpr double kMargin = 0.25;   // of a narrow stretch, that its piece is longer at either end

using Range = std::pair<double, double>;

/// Medians of |r_phi| and |r_phiphi| [m] on a piece; false where it has no value.
struct Usual {
  double speed = 0, bend = 0;
};
bool findUsual(const Curve& curve, double lo, double hi, Usual& usual) {
  std::vector<double> speeds, bends;
  for (int i = 0; i < kSamplesOfTurn && lo < hi; ++i) {
    const CurvePoint p = evaluate(curve, lo + (hi - lo) * (i + 0.5) / kSamplesOfTurn);
    if (!isFinite(p)) continue;
    speeds.push_back(norm(p.rPhi));
    bends.push_back(norm(p.rPhiPhi));
  }
  if (speeds.empty()) return false;
  usual = {narrow::median(speeds), narrow::median(bends)};
  return true;
}

/// Narrow stretches in [lo, hi], with their margins; those that lie near each other are one.
std::vector<Range> findNarrow(ExpressionGraph& graph, const double* shape, const std::vector<int>& r, double lo, double hi,
                              const Usual& usual, int& boxes) {
  const double much = usual.speed + usual.bend;
  int excess = graph.constant(-narrow::kMuch * narrow::kMuch * much * much);
  for (const int bend : graph.differentiate(graph.differentiate(r, 0), 0)) excess = graph.add(excess, graph.powInt(bend, 2));
  const RootSearch search = findRoots(graph, excess, shape, lo, hi, boxes);
  std::vector<Range> found;
  for (std::size_t i = 0; i + 1 < search.roots.size(); ++i) {
    const double a = search.roots[i], b = search.roots[i + 1];
    const std::vector<int> one{excess};
    const double middle = a + (b - a) / 2;
    if (!(evaluateNodes(graph, one, shape, &middle)[0] > 0) || !((b - a) * usual.speed < narrow::kWay)) continue;
    const double more = kMargin * (b - a);
    if (!found.empty() && a - found.back().second < 4 * more + 2 * (found.back().second - found.back().first)) found.back().second = b + more;
    else found.push_back({a - more, b + more});
  }
  return found;
}

void cut(const CurvePiece& piece, const std::vector<Range>& ranges, std::vector<CurvePiece>& parts) {
  CurvePiece rest = piece;
  for (const auto& [a, b] : ranges) {
    if (!(a > rest.lo && b < rest.hi)) continue;
    CurvePiece before = rest, within = rest;
    before.hi = within.lo = a;
    within.hi = rest.lo = b;
    before.placeAtHi = within.placeAtLo = within.placeAtHi = rest.placeAtLo = -1;
    before.passedAtHi = within.passedAtLo = within.passedAtHi = rest.passedAtLo = true;
    within.narrow = true;
    parts.push_back(before);
    parts.push_back(within);
  }
  parts.push_back(rest);
}

}  // namespace

std::vector<CurvePiece> cutAtNarrow(ExpressionGraph& graph, const double* shape, const std::vector<CurvePiece>& pieces,
                                    const std::vector<std::vector<int>>& formulas, double from, double to, double about) {
  std::vector<CurvePiece> parts;
  std::size_t count = 0;
  int boxes = narrow::kBoxes;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const CurvePiece& piece = pieces[k];
    const double lo = std::max(piece.lo, from), hi = std::min(piece.hi, to);
    Usual usual;
    std::vector<Range> narrow;
    if (findUsual(piece.curve, std::max(lo, about - std::numbers::pi), std::min(hi, about + std::numbers::pi), usual))
      narrow = findNarrow(graph, shape, formulas[k], lo, hi, usual, boxes);
    count += narrow.size();
    cut(piece, narrow, parts);
  }
  return count > kMost ? pieces : parts;
}

}  // namespace reachlab::constraints
