#pragma once
#include <array>
#include <memory>
#include <string>

#include "base/math/vec3.h"
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// A curve r(phi) at one parameter value, Eq. (10): position and derivatives with respect to phi, world frame, all [m].
struct CurvePoint {
  Vec3 r, rPhi, rPhiPhi;
};
/// A surface r(u, v) at one point, Eq. (12), all [m].
struct SurfacePoint {
  Vec3 r, rU, rV, rUu, rUv, rVv;
};

/// Evaluates one definition. `program` is the kernel's own data (null for generated code), `shape` its parameters. Any thread; never
/// allocates. Outside the formula's domain the result is not finite.
using CurveFunction = void (*)(const void* program, const double* shape, double phi, CurvePoint& out) noexcept;
using SurfaceFunction = void (*)(const void* program, const double* shape, double u, double v, SurfacePoint& out) noexcept;

/// CurveFunction for eight values of phi, with the same bits as one by one.
struct CurveBatch;  // curve_batch.h
using CurveBatchFunction = void (*)(const void* program, const double* shape, const double* phi, CurveBatch& out) noexcept;

struct Curve {
  CurveFunction function = nullptr;
  CurveBatchFunction batch = nullptr;
  const void* program = nullptr;  // outlives every scene, see Constraint::owner
  std::array<double, kMaxShapeParameters> shape{};
};
struct Surface {
  SurfaceFunction function = nullptr;
  const void* program = nullptr;
  std::array<double, kMaxShapeParameters> shape{};
};
static_assert(std::is_trivially_copyable_v<Curve> && std::is_trivially_copyable_v<Surface>);

/// Room for what is about to be written whole, by a curve's or surface's function, say: it is not cleared beforehand.
template <class T>
union Unfilled {
  T value;
  Unfilled() noexcept {}
};
inline CurvePoint evaluate(const Curve& curve, double phi) noexcept {
  CurvePoint p;
  curve.function(curve.program, curve.shape.data(), phi, p);
  return p;
}
inline SurfacePoint evaluate(const Surface& surface, double u, double v) noexcept {
  SurfacePoint p;
  surface.function(surface.program, surface.shape.data(), u, v, p);
  return p;
}

/// A constraint ready to be computed with: a value, cheap to copy; the owner keeps a typed formula's program alive.
struct Constraint {
  ConstraintKind kind = ConstraintKind::Free;
  std::string name;  // of the definition, or "curve" / "surface" for a typed formula
  Curve curve;       // kind Curve
  Surface surface;   // kind Surface
  std::array<Domain, 2> domain;
  bool straight = false;  // a curve with constant r_phi: dynamics on it are linear
  std::shared_ptr<const void> owner;

  /// Parameters of a mass on it: 0 (free), 1 or 2.
  int parameterCount() const { return static_cast<int>(kind); }
};

/// Builds the constraint of an experiment: looks the name up or compiles the formula. Throws FaultError (unknown name or shape key,
/// value out of range, syntax with the character's place, degenerate everywhere, non-finite in the domain).
/// Each fault stands under `key` or what it has inside: "constraint.curve[1]", "constraint.shape.a".
Constraint makeConstraint(const ConstraintSpec& spec, const std::string& key = "constraint");

}  // namespace reachlab::constraints
