#pragma once
#include <array>
#include <limits>
#include <vector>

#include "base/math/vec3.h"
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

// What a constraint does between its points. Nothing here is for the haptic thread. Typed curves without a domain are looked at on
// [0, 2 pi] (Eq. 10), typed surfaces on [-1, 1] x [-1, 1].

/// The domain with a finite stretch in place of an endless one.
std::array<Domain, 2> boundedDomain(const Constraint& constraint);

/// r and its derivatives r', r'' … up to `order` (at most 4) at phi, from the same graph as the compiled forms. [m]
/// Throws RefusedError on a constraint that is no curve, or a formula too large for this order.
std::vector<Vec3> computeDerivatives(const Constraint& curve, double phi, int order);

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
/// Degenerate places of a surface in its (bounded) domain, ends included; a period's second end is not listed. Empty for curves. Points are
/// searched for from a grid of 97 x 97, until kMaxDegeneratePlaces places are known.
inline constexpr std::size_t kMaxDegeneratePlaces = 64;
std::vector<DegeneratePlace> findDegeneratePlaces(const Constraint& surface);

/// sqrt(det G) / (|r_u| |r_v|), 0 where degenerate: the sine of the angle between the parameter lines.
double computeAngleSine(const SurfacePoint& p) noexcept;

/// First place in the ranges where r, r_phi or r_phiphi (r, and all derivatives of a surface) is not finite, in words
/// ("r_phi is not finite at phi = 1"); empty when it is finite everywhere. Looks between sample points by interval arithmetic.
std::string findNonFinite(const Constraint& constraint, const std::array<Domain, 2>& range);
/// Whether r_phi, or r_u x r_v, vanishes wherever one looks in the ranges.
bool degeneratesEverywhere(const Constraint& constraint, const std::array<Domain, 2>& range);

}  // namespace reachlab::constraints
