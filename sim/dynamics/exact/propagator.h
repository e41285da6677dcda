#pragma once
#include <array>
#include <vector>

#include "sim/dynamics/hand/axis_hand.h"
#include "sim/dynamics/object/object_model.h"

namespace reachlab::dynamics {

/// The exact step of a linear object on one axis, for a force polynomial f(s) = sum f_k s^k on mass 1, s = t/dt:
///   z(dt) = z + D z + sum_k f_k Q_k + g G,   D = exp(A dt) - 1,   Q_k = int_0^dt exp(A (dt-t)) b (t/dt)^k dt.
/// The state is z = (x_1, x_2 - x_1, x_3 - x_2 …, v_1, v_2 - v_1 …), with x_1 measured from the hand at s = 0. The large entries of a stiff
/// spring then multiply its small stretch. D in place of exp leaves slow modes their digits. The result is good to 1e-13 m for any
/// stiffness.
struct Propagator {
  int n = 0;
  double dt = 0;
  std::vector<double> d;                               // (2n)^2, column after column
  std::array<std::vector<double>, kForceTerms> force;  // Q_k for the input vector
  std::vector<double> gravity;                         // G: unit acceleration of every mass
};

/// A Taylor series of a halved step, doubled back with 2D + D^2 and Q_k(2h) = 2^-k (E Q_k + sum_j C(k,j) Q_j). It uses 113 bits, or 64 bits
/// above 24 masses, so that every entry is right to the last bit of a double. Allocates and is not for a tick.
Propagator computePropagator(const ObjectModel& model, bool coupled, double dt);

}  // namespace reachlab::dynamics
