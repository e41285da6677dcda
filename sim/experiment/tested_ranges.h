#pragma once
#include <fmt/format.h>

#include "base/number_range.h"

/// The ranges in which the methods were tested (tests/cli/bounds_test.cpp): beyond them a computation may not end. The schema has the same.
namespace reachlab::experiment {

inline NumberRange between(double lo, double hi, const std::string& unit) {
  return {lo, hi, true, fmt::format("{:g} to {:g}{}{}", lo, hi, unit.empty() ? "" : " ", unit)};
}
/// Zero: the object has no such part.
inline NumberRange upTo(double most, const std::string& unit) { return between(0, most, unit); }

inline NumberRange massRange() { return between(1e-6, 1e6, "kg"); }
/// Of a hand. Zero is allowed.
inline NumberRange handMassRange() { return upTo(1e6, "kg"); }
inline NumberRange inertiaRange() { return between(1e-12, 1e6, "kg m^2"); }
inline NumberRange stiffnessRange() { return upTo(1e9, "N/m"); }
inline NumberRange dampingRange() { return upTo(1e9, "N s/m"); }
inline NumberRange forceRange() { return between(1e-6, 1e6, "N"); }
/// Of a tolerance, a radius, a link.
inline NumberRange lengthRange() { return between(1e-9, 1e6, "m"); }
inline NumberRange speedRange() { return between(1e-9, 1e6, "m/s"); }
/// Of a component: a place, an offset, an acceleration, a formula's own number.
inline NumberRange componentRange() { return between(-1e9, 1e9, ""); }
/// Of a movement.
inline NumberRange durationRange() { return between(1e-3, 3600, "s"); }

}  // namespace reachlab::experiment
