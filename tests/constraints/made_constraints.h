#pragma once
#include <map>
#include <string>
#include <vector>

#include "constraints/constraint.h"

namespace reachlab::constraints {

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

}  // namespace reachlab::constraints
