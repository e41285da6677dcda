#include "gui/scene_plan/place_marks.h"

#include "base/fault.h"
#include "constraints/regularity/places.h"
#include "constraints/regularity/surface_branches.h"

namespace reachlab::gui::scene {
namespace {

constexpr std::size_t kMostMarks = 400;

std::vector<PlaceMark> markCurve(const constraints::Constraint& c, const constraints::Domain& drawn, double about) {
  std::vector<PlaceMark> marks;
  const constraints::CurveRegularity regularity = computeRegularity(c, about);
  for (const constraints::Place& place : regularity.places)
    if (place.at >= drawn.lo && place.at <= drawn.hi && isFinite(place.r) && marks.size() < kMostMarks)
      marks.push_back({place.r, isPassed(place.kind)});
  return marks;
}

// Where a line's argument changes its sign from one node of a grid to the next.
std::vector<PlaceMark> markSurface(const constraints::Constraint& c, const std::array<constraints::Domain, 2>& drawn) {
  constexpr int kPlacesAcross = 64;
  std::vector<PlaceMark> marks;
  const auto branches = constraints::computeBranches(c);
  if (branches->smooth()) return marks;
  const auto at = [&](std::size_t k, int i) { return drawn[k].lo + (drawn[k].hi - drawn[k].lo) * i / kPlacesAcross; };
  for (std::size_t line = 0; line < branches->lines.size(); ++line)
    for (int i = 0; i <= kPlacesAcross; ++i)
      for (int j = 0; j <= kPlacesAcross; ++j)
        for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}}) {
          if (i + di > kPlacesAcross || j + dj > kPlacesAcross || marks.size() >= kMostMarks) continue;
          const double u = at(0, i), v = at(1, j), value = branches->at(u, v)[line].value;
          const double next = branches->at(at(0, i + di), at(1, j + dj))[line].value;
          if (!(value * next <= 0) || next == 0) continue;
          const double share = value / (value - next), size = drawn[0].hi - drawn[0].lo, height = drawn[1].hi - drawn[1].lo;
          const Vec3 r = evaluate(c.surface, u + di * share * size / kPlacesAcross, v + dj * share * height / kPlacesAcross).r;
          if (isFinite(r)) marks.push_back({r, isPassed(branches->lines[line].kind)});
        }
  return marks;
}

}  // namespace

std::vector<PlaceMark> markPlaces(const constraints::Constraint& constraint, const std::array<constraints::Domain, 2>& drawn,
                                  const std::vector<double>& about) {
  try {
    if (constraint.kind == constraints::ConstraintKind::Curve)
      return markCurve(constraint, drawn[0], about.empty() ? 0.5 * (drawn[0].lo + drawn[0].hi) : about[0]);
    if (constraint.kind == constraints::ConstraintKind::Surface) return markSurface(constraint, drawn);
  } catch (const FaultError&) {  // too many lines: said where the scene is compiled
  }
  return {};
}

}  // namespace reachlab::gui::scene
