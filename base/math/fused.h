#pragma once
#include "base/math/vec3.h"

/// a b + c with one rounding. The compiler itself fuses nothing (-ffp-contract=off). A kernel that gains from a fused operation calls one
/// of these functions, and the result is the same in every build. On a processor without the instruction the C library computes the same
/// bits, slowly. Any thread. See docs/adr/0020-fused-operations-are-written-out.md.
namespace reachlab {

[[gnu::always_inline]] inline double mulAdd(double a, double b, double c) noexcept { return __builtin_fma(a, b, c); }

/// Component by component.
[[gnu::always_inline]] inline Vec3 mulAdd(double s, const Vec3& a, const Vec3& b) noexcept {
  return {mulAdd(s, a.x, b.x), mulAdd(s, a.y, b.y), mulAdd(s, a.z, b.z)};
}

/// a.b + c with one rounding per term. (a, b) and (b, a) give the same result.
[[gnu::always_inline]] inline double mulAdd(const Vec3& a, const Vec3& b, double c) noexcept {
  return mulAdd(a.x, b.x, mulAdd(a.y, b.y, mulAdd(a.z, b.z, c)));
}
[[gnu::always_inline]] inline double fusedDot(const Vec3& a, const Vec3& b) noexcept {
  return mulAdd(a.x, b.x, mulAdd(a.y, b.y, a.z * b.z));
}

}  // namespace reachlab
