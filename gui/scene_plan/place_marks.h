#pragma once
#include <array>
#include <vector>

#include "base/math/vec3.h"
#include "constraints/constraint_spec.h"

namespace reachlab::gui::scene {

/// A place where a constraint's formula is not smooth, to be marked on the picture.
struct PlaceMark {
  Vec3 r;               // [m]
  bool passed = false;  // a mass goes on across it; else never crossed
};

/// The constraint's list of singular positions (constraints/regularity/places.h) in the drawn domain. Lines of a surface become points
/// along them. `about`: the start, if there is a task.
std::vector<PlaceMark> markPlaces(const constraints::Constraint& constraint, const std::array<constraints::Domain, 2>& drawn,
                                  const std::vector<double>& about);

}  // namespace reachlab::gui::scene
