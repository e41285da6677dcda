#pragma once
#include <array>
#include <vector>

#include "base/math/vec3.h"
#include "sim/experiment/object_limits.h"

namespace reachlab::experiment {

enum class ObjectKind { Point, Chain, Parallel, Body, None };

/// The simulated object (paper sec. 3-5). Chain: N masses, N-1 springs, the hand drives mass 1. Parallel: N masses, each tied to the
/// hand by its own spring. Body: one mass with inertia, driven at an offset from its centre. None: the hand
/// moves alone, without masses and coupling.
struct Object {
  ObjectKind kind = ObjectKind::Point;
  std::vector<double> masses;                      // [kg]
  std::vector<double> stiffness;                   // [N/m]
  std::vector<double> damping;                     // [N s/m], as many as stiffness
  double viscosity = 0;                            // [N s/m] lambda of Eq. (9), on every mass
  Vec3 gravity;                                    // [m/s^2]
  std::array<std::array<double, 3>, 3> inertia{};  // [kg m^2] body frame, body only
  Vec3 fpOffset;                                   // [m] body frame, body only
  bool operator==(const Object&) const = default;
};

/// How many springs the object has for its masses.
inline std::size_t springCount(const Object& object) {
  const bool parallel = object.kind == ObjectKind::Parallel;
  return object.masses.empty() ? 0 : object.masses.size() - (parallel ? 0 : 1);
}

/// Spring-damper between HIP and FP, Eq. (8).
struct Coupling {
  double stiffness = 0;  // [N/m]
  double damping = 0;    // [N s/m]
  bool operator==(const Coupling&) const = default;
};

/// One of several hands on one object, each coupled by Eq. (8) for itself: to one mass, or to every mass by a separate spring.
struct Hand {
  int mass = 1;                            // from 1; 0: to all, and both lists have a number for each
  std::vector<double> stiffness, damping;  // [N/m], [N s/m]; one number where one mass is held
  Vec3 fpOffset;                           // [m] where it holds a body, body frame
  bool operator==(const Hand&) const = default;
};

}  // namespace reachlab::experiment
