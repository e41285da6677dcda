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

/// Evaluates one definition. `program` is the kernel's data (null for generated code) and `shape` holds the shape's parameters. Outside the
/// formula's domain the result is not finite. Any thread. Never allocates.
using CurveFunction = void (*)(const void* program, const double* shape, double phi, CurvePoint& out) noexcept;
using SurfaceFunction = void (*)(const void* program, const double* shape, double u, double v, SurfacePoint& out) noexcept;

/// CurveFunction for eight values of phi at once, with the same bits as eight single calls.
struct CurveBatch;  // curve_batch.h
using CurveBatchFunction = void (*)(const void* program, const double* shape, const double* phi, CurveBatch& out) noexcept;

struct Curve {
  CurveFunction function = nullptr;
  CurveBatchFunction batch = nullptr;
  const void* program = nullptr;  // outlives every scene, see Constraint::formula
  std::array<double, kMaxShapeParameters> shape{};
};
struct Surface {
  SurfaceFunction function = nullptr;
  const void* program = nullptr;
  std::array<double, kMaxShapeParameters> shape{};
};
static_assert(std::is_trivially_copyable_v<Curve> && std::is_trivially_copyable_v<Surface>);

/// Memory that the function of a curve or surface will fill completely. It is not cleared beforehand.
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

/// A constraint that is ready for computation. It is a value and cheap to copy. Its formula is kept with it.
struct Constraint {
  ConstraintKind kind = ConstraintKind::Free;
  std::string name;  // of the definition, or "curve" / "surface" for a typed formula
  Curve curve;       // kind Curve
  Surface surface;   // kind Surface
  std::array<Domain, 2> domain;
  bool straight = false;                           // a curve with constant r_phi: dynamics on it are linear
  std::shared_ptr<const CompiledFormula> formula;  // null if free

  /// Parameters of a mass on it: 0 (free), 1 or 2.
  int parameterCount() const { return static_cast<int>(kind); }
  /// The values of the formula's parameters.
  const double* shape() const { return (kind == ConstraintKind::Curve ? curve.shape : surface.shape).data(); }
};

/// Builds the constraint of an experiment: looks the name up or compiles the formula. Throws FaultError for an unknown name or shape key, a
/// value out of range, wrong syntax (with the character's position), and a curve or surface that is degenerate everywhere or not finite in
/// its domain. The key of each fault is `key` or a key inside it: "constraint.curve[1]", "constraint.shape.a".
Constraint makeConstraint(const ConstraintSpec& spec, const std::string& key = "constraint");

}  // namespace reachlab::constraints
