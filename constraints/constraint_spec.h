#pragma once
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace reachlab::constraints {

inline constexpr int kMaxShapeParameters = 8;

// These types are defined in constraint.h.
struct Constraint;
struct Curve;
struct Surface;
struct CurvePoint;
struct SurfacePoint;
struct CurveBatch;
struct CompiledFormula;  // formula.h

enum class ConstraintKind { Free, Curve, Surface };
/// What happens where an open parameter domain ends: the run stops there with a reason, or the end is an elastic stop.
enum class AtEnd { Stop, Bounce };

/// Range of one parameter, infinite where the formula has no end. If `periodic`, hi and lo are the same position, and the parameter itself
/// continues beyond them.
struct Domain {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool periodic = false;
  AtEnd atEnd = AtEnd::Stop;
  /// Where the domain is periodic, every number is in it. NaN is in none that has ends.
  bool has(double parameter) const noexcept { return periodic || (parameter >= lo && parameter <= hi); }
  bool operator==(const Domain&) const = default;
};

/// The constraint as an experiment names it: a name of the catalogue ("free" for no constraint) or the formula itself, and the shape.
struct ConstraintSpec {
  std::string name = "line";
  std::vector<std::string> curve = {};    // one formula a coordinate in `phi`; empty if named
  std::vector<std::string> surface = {};  // one formula a coordinate in `u`, `v`; empty if named
  std::map<std::string, double> shape = {};
  /// The range in which a typed formula will be used (the hull of start and target). The formula and its derivatives must be finite there.
  /// The movement itself has no ends. If unknown: phi in [0, 2 pi] (Eq. 10), u and v in [-1, 1].
  std::optional<std::array<Domain, 2>> inUse = std::nullopt;
  /// The text of the named definition where it is not to be looked up: a recorded run brings its own. Empty: looked up.
  std::string definition = {};
  bool operator==(const ConstraintSpec&) const = default;
};

}  // namespace reachlab::constraints
