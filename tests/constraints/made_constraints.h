#pragma once
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "constraints/constraint.h"
#include "tests/refusal.h"

namespace reachlab::constraints {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kRounding = 1e-15;  // a few roundings of numbers below 1

/// A constraint by its name, or by the formulas of its coordinates.
inline Constraint named(const std::string& name, const std::map<std::string, double>& shape = {}) {
  return makeConstraint(ConstraintSpec{.name = name, .shape = shape});
}
inline Constraint curve(const std::vector<std::string>& formula, const std::map<std::string, double>& shape = {}) {
  return makeConstraint(ConstraintSpec{.curve = formula, .shape = shape});
}
inline Constraint surface(const std::vector<std::string>& formula, const std::map<std::string, double>& shape = {}) {
  return makeConstraint(ConstraintSpec{.surface = formula, .shape = shape});
}

/// The sentence with which the constraint c is refused. Empty if it is accepted.
inline std::string refusalOfConstraint(const ConstraintSpec& spec) {
  return refusalOf([&] { (void)makeConstraint(spec, "c"); });
}

}  // namespace reachlab::constraints
