#pragma once
#include <array>
#include <optional>

#include "base/math/fused.h"
#include "constraints/constraint_spec.h"

namespace reachlab::dynamics {

/// A surface of second degree, F(r) = d.A d + b.d + c = 0 with d = r - centre [m]. F is scaled so that its gradient has a length of about
/// 1. Examples are spheres, ellipsoids, paraboloids, cones, cylinders and hyperboloids. On them a mass can be followed in world
/// coordinates, where the poles of a parametrisation do not matter.
struct Quadric {
  std::array<double, 6> a{};  // A: xx, yy, zz, xy, xz, yz [1/m]
  Vec3 b;                     // no unit
  double c = 0;               // [m]
  Vec3 centre;                // [m] of the sampled points

  /// A d for any vector [1/m times its unit].
  Vec3 times(const Vec3& d) const noexcept {
    return {fusedDot({a[0], a[3], a[4]}, d), fusedDot({a[3], a[1], a[5]}, d), fusedDot({a[4], a[5], a[2]}, d)};
  }
  Vec3 gradient(const Vec3& r) const noexcept { return mulAdd(2.0, times(r - centre), b); }
  double value(const Vec3& r) const noexcept {
    const Vec3 d = r - centre;
    return mulAdd(d, times(d) + b, c);
  }
};

/// The surface of a ball.
struct Sphere {
  Vec3 middle;        // [m]
  double radius = 0;  // [m]
};
/// The sphere that a quadric is, to rounding. Empty for every other form.
std::optional<Sphere> sphereOf(const Quadric& quadric);

/// True if F and its gradient vanish together somewhere near the samples: at the apex of a cone, or on the line in which two planes meet.
bool hasApex(const Quadric& quadric);

/// The quadric on which the whole parametrised surface lies, found from samples of r(u, v) alone (the null vector of their monomials).
/// Empty if the surface is not of second degree, not unique (a plane), or not finite. Infinite domains are sampled over `start` ± 3.
/// Allocates.
std::optional<Quadric> fitQuadric(const constraints::Surface& surface, const std::array<constraints::Domain, 2>& domain,
                                  const std::array<double, 2>& start);

/// True if F(r(u, v)) vanishes identically on the whole domain, also in narrow bumps between samples. It is proved on the formula, as a
/// polynomial in its sines, roots … with their identities. The formula must be analytic there. Allocates.
bool provesQuadric(const constraints::Constraint& surface, const Quadric& quadric);

}  // namespace reachlab::dynamics
