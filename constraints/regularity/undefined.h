#pragma once
#include <array>
#include <optional>

#include "base/fault.h"
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// Of a curve or surface that has no value anywhere in the range: the coordinate, the part of its formula that has no value there, and what
/// that part needs. nullopt if it has a value somewhere.
std::optional<Fault> undefinedFault(const Constraint& constraint, const std::array<Domain, 2>& range);

}  // namespace reachlab::constraints
