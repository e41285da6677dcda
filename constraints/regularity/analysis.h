#pragma once
#include <array>
#include <limits>
#include <vector>

#include "base/math/vec3.h"
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

// Properties of a constraint between its sample points. Nothing here is for the haptic thread. Typed curves without a domain are examined
// on [0, 2 pi] (Eq. 10), typed surfaces on [-1, 1] x [-1, 1].

/// The domain with a finite stretch in place of an infinite range.
std::array<Domain, 2> boundedDomain(const Constraint& constraint);

struct SlowPlace {
  double phi = 0;
  double speed = 0;  // [m] |r_phi|
};
/// The smallest |r_phi| in [lo, hi].
SlowPlace findMinSpeed(const Constraint& curve, double lo, double hi);

/// How a surface's parametrisation fails at a place where det G = 0.
enum class DegenerateKind {
  Pole,  // a whole parameter line is one point and the surface is smooth there: geodesics go on
  Apex,  // a whole parameter line is one point, with no tangent plane (a cone's tip): no continuation
  Edge,  // a cuspidal edge: r_u, r_v parallel along a line of distinct points: no continuation across
  Pinch  // an isolated singular point (Whitney's umbrella): no unique continuation
};
const char* nameOf(DegenerateKind kind);

struct DegeneratePlace {
  DegenerateKind kind = DegenerateKind::Pole;
  double u = 0, v = 0;  // a place of it; for a line of places the fixed parameter counts
  int fixed = -1;       // Pole, Apex, Edge: 0 when the line is u = const, 1 when it is v = const; -1 otherwise
  Vec3 r;               // [m]
  Vec3 normal;          // Pole: unit normal there
};
/// Degenerate positions of a surface in its (bounded) domain, ends included. A period's second end is not listed. Empty for curves.
/// Isolated points are searched for from a grid of 97 x 97, until kMaxDegeneratePlaces positions are known.
inline constexpr std::size_t kMaxDegeneratePlaces = 64;
std::vector<DegeneratePlace> findDegeneratePlaces(const Constraint& surface);

/// sqrt(det G) / (|r_u| |r_v|), 0 where degenerate: the sine of the angle between the parameter lines.
double computeAngleSine(const SurfacePoint& p) noexcept;

/// The first position in the ranges where r or a derivative is not finite, as a text: "r_phi is not finite at phi = 1". It looks at r,
/// r_phi and r_phiphi of a curve, and at r and all derivatives of a surface. Empty when all are finite. Interval arithmetic looks between
/// sample points.
std::string findNonFinite(const Constraint& constraint, const std::array<Domain, 2>& range);
/// Whether r_phi, or r_u x r_v, vanishes wherever one looks in the ranges.
bool degeneratesEverywhere(const Constraint& constraint, const std::array<Domain, 2>& range);

}  // namespace reachlab::constraints
