#pragma once
#include <vector>

#include "sim/predict/double_double.h"
#include "sim/predict/line_object.h"
#include "sim/predict/predict.h"

namespace reachlab::predict {

/// x' = A x + b u from x(0) = 0 to x(T) = target with least integral of u^2 (criteria.md 5). The first `controlled` states are
/// the problem; those after them only follow (a massless hand behind a damper) and are driven by the first. Springs and masses
/// are energy coordinates, sqrt(k) elongation and sqrt(m) velocity, so that exp(A t) does not grow.
template <class Real>
struct LineSystem {
  int size = 0, controlled = 0;
  int elongations = 0, velocities = 0;    // states 0 … elongations-1, then the velocities
  std::vector<Real> a;                    // size x size, row by row
  std::vector<Real> b, target;            // size
  std::vector<std::vector<Real>> output;  // positions of the hand, then of the masses [m]: size + 1 coefficients, the last of u
  bool handJumps = false;                 // the control reaches the hand's position at once
  bool handVelocityJumps = false;
};

/// Criteria 1, 4, 5, 6 and the hand-crackle variant; any damping. Real is double or DoubleDouble.
template <class Real>
LineSystem<Real> makeLineSystem(const LineObject& object, Criterion criterion, double distance);

/// Turns springs and masses to the object's own modes by the singular value decomposition of their coupling, an orthogonal change
/// of coordinates; each state is then about one mode and can be scaled by itself.
void rotateToModes(LineSystem<double>& system);

}  // namespace reachlab::predict
