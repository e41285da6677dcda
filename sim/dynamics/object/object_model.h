#pragma once
#include <vector>

#include "sim/experiment/experiment_fwd.h"
#include "sim/experiment/object.h"

namespace reachlab::dynamics {

/// The numbers that every form of the equations of motion needs of an object and its coupling; the hand's springs stand beside each
/// mass (a chain's only on mass 1, Eq. (8); a parallel object's on all, paper sec. 5).
struct ObjectModel {
  experiment::ObjectKind kind = experiment::ObjectKind::Point;
  std::vector<double> mass;                        // [kg] N
  std::vector<double> stiffness, damping;          // [N/m], [N s/m] between neighbours, N-1; empty for parallel
  std::vector<double> handStiffness, handDamping;  // [N/m], [N s/m] to the hand, N; of several hands the sum
  double viscosity = 0;                            // [N s/m] on every mass
  Vec3 gravity;                                    // [m/s^2]

  int count() const { return static_cast<int>(mass.size()); }
};

/// Throws RefusedError for what no method can integrate (a mass that is not positive, numbers that are not finite, wrong counts).
ObjectModel makeObjectModel(const experiment::Experiment& experiment);

/// 1/s; the largest |eigenvalue| of the object with every spring along one line, by Gershgorin's discs: an upper bound.
double boundFastestMode(const ObjectModel& model);

}  // namespace reachlab::dynamics
