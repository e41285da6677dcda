#pragma once
#include <array>
#include <optional>

#include "base/fault.h"
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// The fault of a curve or surface without any value in the range. It names the coordinate, the part of the formula without a value, and the
/// numbers that this part allows. nullopt if the formula has a value somewhere.
std::optional<Fault> undefinedFault(const Constraint& constraint, const std::array<Domain, 2>& range);

}  // namespace reachlab::constraints
