#include <algorithm>
#include <cmath>

#include "constraints/formula/roots.h"
#include "constraints/regularity/curve_search.h"

namespace reachlab::constraints {
namespace {

constexpr double kStill = 1e-7;      // of the largest |r_phi| beside it: what rounding leaves of a place where it vanishes
constexpr double kRunsBack = 1e-9;   // of the way beside it: both sides are one
constexpr double kRounding = 1e-18;  // [m]

double speedAt(const Curve& curve, double phi) { return norm(evaluate(curve, phi).rPhi); }

/// The largest |r_phi| from one to a hundred steps beside a place.
double speedAround(const CurveStretch& stretch, double phi, double step) {
  double around = 0;
  for (const double steps : {1.0, 10.0, 100.0})
    for (const double side : {-1.0, 1.0})
      if (const double s = speedAt(stretch.curve, std::clamp(phi + side * steps * step, stretch.lo, stretch.hi)); std::isfinite(s))
        around = std::max(around, s);
  return around;
}

/// By the tangents on both sides: turned round, and on the same way back or not.
PlaceKind kindOf(const Curve& curve, double phi, const Vec3& r, double step) {
  const CurvePoint before = evaluate(curve, phi - step), after = evaluate(curve, phi + step);
  const double turn = dot(before.rPhi, after.rPhi) / (norm(before.rPhi) * norm(after.rPhi));
  const bool same = norm(before.r - after.r) <= kRunsBack * norm(after.r - r) + kRounding;
  return turn > 0 ? PlaceKind::Standstill : same ? PlaceKind::Fold : PlaceKind::Cusp;
}

}  // namespace

std::vector<Place> findStillPlaces(ExpressionGraph& graph, const double* shape, const CurveStretch& stretch, int& boxes, std::size_t most) {
  std::vector<Place> places;
  if (!(stretch.lo < stretch.hi)) return places;
  const std::vector<int> d = graph.differentiate(stretch.r, 0);
  int square = graph.powInt(d[0], 2);
  for (int k = 1; k < 3; ++k) square = graph.add(square, graph.powInt(d[k], 2));
  const double step = std::min(1e-4, 1e-3 * std::max(1.0, stretch.hi - stretch.lo));
  for (const double phi : findRoots(graph, square, shape, stretch.lo, stretch.hi, boxes).roots) {
    if (places.size() >= most) break;
    if (!(speedAt(stretch.curve, phi) <= kStill * speedAround(stretch, phi, step))) continue;
    Place place;
    place.at = phi + 0.0;
    place.r = evaluate(stretch.curve, phi).r;
    place.because = "r_phi = 0";
    place.kind = kindOf(stretch.curve, phi, place.r, step);
    places.push_back(place);
  }
  return places;
}

}  // namespace reachlab::constraints
