#pragma once
#include <array>
#include <functional>
#include <optional>

#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// One instant of a movement over a surface: u, v and their first two derivatives by time [1/s], [1/s^2].
struct WayPoint {
  std::array<double, 2> q{}, rate{}, acceleration{};
};

/// Between the samples of a movement the surface bends more than it does at any of them.
struct HiddenBend {
  bool found = false;  // false: there may be one, interval arithmetic showed neither
  std::array<double, 2> at{};
};
/// Looks at the part of a movement's jerk that comes from the surface's second and third derivatives, between 513 samples at equal shares
/// of its time (0 … 1). Returns nothing where this part is proved to stay within twice its largest sample, or within `least` [m/s^3].
/// Interval arithmetic runs over boxes round ever shorter pieces of the path, so that no bump is too narrow. Between two samples the
/// parameters are assumed to leave their hull by at most a quarter of it, as in a resolved movement. Definitions of the catalogue have
/// known shapes and return nothing. Allocates.
std::optional<HiddenBend> findHiddenBend(const Constraint& surface, const std::function<WayPoint(double share)>& way, double least);

}  // namespace reachlab::constraints
