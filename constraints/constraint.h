#pragma once
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/math/vec3.h"
#include "constraints/curve_batch.h"

namespace reachlab::constraints {

inline constexpr int kMaxShapeParameters = 8;

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

enum class ConstraintKind { Free, Curve, Surface };
/// What happens where an open parameter domain ends: the run stops there with a reason, or the end is an elastic stop.
enum class AtEnd { Stop, Bounce };

/// Range of one parameter; infinite where the formula has no end. `periodic`: hi is the same place as lo, the parameter itself runs on.
struct Domain {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool periodic = false;
  AtEnd atEnd = AtEnd::Stop;
  bool operator==(const Domain&) const = default;
};

/// What an experiment says of its constraint: a name of the catalogue ("free" for none) or the formula itself, and the shape.
struct ConstraintSpec {
  std::string name = "line";
  std::vector<std::string> curve;    // one formula a coordinate in `phi`; empty if named
  std::vector<std::string> surface;  // one formula a coordinate in `u`, `v`; empty if named
  std::map<std::string, double> shape;
  /// Where a typed formula will be moved on (the hull of start and target): there it must be finite with its derivatives; the motion itself
  /// has no ends. Not known: phi in [0, 2 pi] (Eq. 10), u and v in [-1, 1].
  std::optional<std::array<Domain, 2>> inUse = std::nullopt;
  /// The text of the named definition where it is not to be looked up: a recorded run brings its own. Empty: looked up.
  std::string definition = {};
  bool operator==(const ConstraintSpec&) const = default;
};

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
