#pragma once
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "constraints/constraint.h"

namespace reachlab::constraints {

/// The kinds of positions where a formula is not smooth. docs/constraints.md describes the movement of a mass at each.
enum class PlaceKind {
  Kink,       // the direction turns, or |r_phi| jumps (abs): passed with the tangential speed
  Bend,       // only a second derivative jumps: passed
  Hole,       // 0/0 with a limit (sin(phi)/phi at 0): passed by the limit
  Jump,       // r itself jumps (sign, the cut of atan2): never crossed
  Pole,       // r grows without bound (log, 1/x, tan): never crossed
  End,        // no value beyond (sqrt, asin): never crossed
  Spike,      // r_phi or r_phiphi has no limit on either side (sqrt(abs(phi))): never crossed
  Cusp,       // r_phi = 0 and the tangent turns round: passed in arc length
  Fold,       // r_phi = 0 and the curve runs back on itself: passed in arc length, like a reflection
  Standstill  // r_phi = 0 but the tangent does not turn (phi^3): passed in arc length
};
const char* nameOf(PlaceKind kind);
/// A mass continues across it.
bool isPassed(PlaceKind kind);

struct Place {
  PlaceKind kind = PlaceKind::Kink;
  int parameter = 0;    // 0: at phi = `at`, or u = `at`; 1: at v = `at`; -1: along a line of a surface that is none of its parameter lines
  double at = 0;        // [1]
  Vec3 r;               // [m] there; not finite at a pole
  std::string because;  // the operation: "abs(phi - 1)"
};
/// "kink at phi = 1: abs(phi - 1)".
std::string describe(const Place& place, ConstraintKind kind);

/// A stretch of a curve on which its formula is analytic, with the branch that the formula has there.
struct CurvePiece {
  double lo = 0, hi = 0;               // where a mass may be
  Curve curve;                         // runs on smoothly a little beyond both ends, for what a step looks at
  int placeAtLo = -1, placeAtHi = -1;  // index in CurveRegularity::places; -1: none (end of the domain, or of what was examined; a seam)
  bool passedAtLo = false, passedAtHi = false;  // a mass goes on into the neighbouring piece
};

/// A stretch on which a curve turns within less than the way of a tick.
struct NarrowPlace {
  double lo = 0, hi = 0;
  double reach = 0;  // of phi, that a step may cover there and still see all of it
};

/// The result of interval analysis of a curve's formula graph.
struct CurveRegularity {
  double lo = 0, hi = 0;              // examined: the statement holds between these; infinite where it holds everywhere
  std::vector<Place> places;          // in order of phi
  std::vector<CurvePiece> pieces;     // in order; one where the formula is analytic throughout
  std::shared_ptr<const void> owner;  // keeps the pieces' programs alive
  /// The narrow places of a typed formula, in order, all those between phi = seenLo and seenHi. A definition of the catalogue has no such places.
  std::vector<NarrowPlace> narrow;
  double seenLo = -std::numeric_limits<double>::infinity(), seenHi = std::numeric_limits<double>::infinity();
  /// No place was found: smooth, and nowhere still.
  bool smooth = false;
  /// One piece, which is the whole domain.
  bool whole = false;

  /// The piece that holds phi, and on a boundary the upper piece. It is -1 where the formula has no value or was not examined.
  int pieceAt(double phi) const;
  /// How far a step may lead from phi, upwards or downwards, so that it steps over nothing of a narrow place. Infinite where no narrow place
  /// lies ahead.
  double reachFrom(double phi, bool upwards) const noexcept;
};

/// Examines the domain. Where it has no end, everything is examined if the formula can be proved analytic everywhere. Otherwise a stretch
/// about `about` is examined: 64 turns, and at least 10 m either way. It allocates, so it is not for the haptic thread. A constraint
/// without a formula (free) has no such positions.
CurveRegularity computeRegularity(const Constraint& curve, double about);
/// The same for [lo, hi] alone, and without a search for places where r_phi = 0.
CurveRegularity computeRegularityWithin(const Constraint& curve, double lo, double hi);

/// Those strictly between two parameter values (in either order).
std::vector<Place> placesBetween(const CurveRegularity& regularity, double from, double to);

}  // namespace reachlab::constraints
