#pragma once
#include <array>
#include <memory>
#include <vector>

#include "base/math/vec3.h"
#include "constraints/constraint_spec.h"
#include "constraints/formula/formula.h"

namespace reachlab::constraints {

/// All partial derivatives of r(u, v) at one point: d[a][b] = r_(u^a v^b) [m], for a + b up to the requested order. Higher ones are 0.
inline constexpr int kMaxExpansion = 5;
using SurfaceExpansion = std::array<std::array<Vec3, kMaxExpansion + 1>, kMaxExpansion + 1>;

/// A surface's formula, prepared for Taylor series. It is the same graph as the compiled forms, with each operation done on polynomials in
/// (du, dv) instead of numbers (Griewank and Walther, Evaluating Derivatives, ch. 13). It is exact except for rounding, at any scale of the
/// parameters. Immutable. Any thread. It allocates, so it is not for the haptic thread.
class SurfaceFormula {
 public:
  /// Throws RefusedError on a constraint that is no surface.
  explicit SurfaceFormula(const Constraint& surface);
  /// Order 0 … kMaxExpansion. Outside the formula's domain, and where a derivative has no value, the result is not finite.
  SurfaceExpansion expand(double u, double v, int order) const;

 private:
  OperationList list_;
};

}  // namespace reachlab::constraints
