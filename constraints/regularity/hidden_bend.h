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
/// Looks at what of a movement's jerk comes from the surface's second and third derivatives, between 513 samples at equal shares of its time
/// (0 … 1): nothing where it is shown to stay within twice the largest at the samples, or within `least` [m/s^3]. By interval arithmetic
/// over boxes round ever shorter pieces of the way, so that a bump is seen however narrow. Between two looks the parameters are taken to
/// leave their hull by no more than a quarter of it, as those of a resolved movement do. Nothing for definitions of the catalogue, whose
/// shapes are known. Allocates.
std::optional<HiddenBend> findHiddenBend(const Constraint& surface, const std::function<WayPoint(double share)>& way, double least);

}  // namespace reachlab::constraints
