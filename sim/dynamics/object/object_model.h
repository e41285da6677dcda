#pragma once
#include <array>
#include <vector>

#include "sim/dynamics/object/hand_springs.h"
#include "sim/experiment/experiment_fwd.h"
#include "sim/experiment/object.h"

namespace reachlab::dynamics {

/// The numbers of an object and its coupling that every form of the equations of motion needs. The springs of the hand belong to the
/// masses. A chain has a hand spring on mass 1 only, Eq. (8). A parallel object has a hand spring on each mass, paper sec. 5.
struct ObjectModel {
  experiment::ObjectKind kind = experiment::ObjectKind::Point;
  std::vector<double> mass;                          // [kg] N
  std::vector<double> stiffness = {}, damping = {};  // [N/m], [N s/m] between neighbours, N-1; empty for parallel
  std::vector<double> handStiffness, handDamping;    // [N/m], [N s/m] to the hand, N; the sum over several hands
  double viscosity = 0;                              // [N s/m] on every mass
  Vec3 gravity = {};                                 // [m/s^2]
  // A body only: its inertia [kg m^2] in its own frame, and the hands that hold it.
  std::array<std::array<double, 3>, 3> inertia{};
  std::vector<HandSprings> hands = {};

  int count() const { return static_cast<int>(mass.size()); }
};

/// Throws RefusedError for a model that no method can integrate: a mass that is not positive, numbers that are not finite, wrong counts.
ObjectModel makeObjectModel(const experiment::Experiment& experiment);

/// The largest |eigenvalue| [1/s] of the object with every spring along one line. An upper bound by Gershgorin's discs.
double boundFastestMode(const ObjectModel& model);

}  // namespace reachlab::dynamics
