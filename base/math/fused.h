#pragma once
#include "base/math/vec3.h"

/// a b + c with one rounding. The compiler fuses nothing on its own (-ffp-contract=off): where a kernel gains from a fused operation it
/// calls one of these, and the result is the same in every build. A processor without the instruction leaves it to the C library, which
/// computes the same bits, slowly. Any thread; see docs/adr/0020-fused-operations-are-written-out.md.
namespace reachlab {

[[gnu::always_inline]] inline double mulAdd(double a, double b, double c) noexcept { return __builtin_fma(a, b, c); }

/// Component by component.
[[gnu::always_inline]] inline Vec3 mulAdd(double s, const Vec3& a, const Vec3& b) noexcept {
  return {mulAdd(s, a.x, b.x), mulAdd(s, a.y, b.y), mulAdd(s, a.z, b.z)};
}

/// a.b + c with one rounding a term; the same for (a, b) as for (b, a).
[[gnu::always_inline]] inline double mulAdd(const Vec3& a, const Vec3& b, double c) noexcept {
  return mulAdd(a.x, b.x, mulAdd(a.y, b.y, mulAdd(a.z, b.z, c)));
}
[[gnu::always_inline]] inline double fusedDot(const Vec3& a, const Vec3& b) noexcept {
  return mulAdd(a.x, b.x, mulAdd(a.y, b.y, a.z * b.z));
}

}  // namespace reachlab
