#pragma once
#include <vector>

#include "sim/predict/line/line_object.h"
#include "sim/predict/numerics/double_double.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// x' = A x + b u from x(0) = 0 to x(T) = target with least integral of u^2 (docs/theory/criteria.md, "Pontryagin's conditions"). Only the
/// first `controlled` states have conditions. The states after them are driven by these (a massless hand behind a damper). Springs and
/// masses are energy coordinates, sqrt(k) elongation and sqrt(m) velocity, so that exp(A t) does not grow.
struct ControlProblem {
  int size = 0, controlled = 0;
  int elongations = 0, velocities = 0;            // states 0 … elongations-1, then the velocities
  std::vector<DoubleDouble> a;                    // size x size, row by row
  std::vector<DoubleDouble> b, target;            // size
  std::vector<std::vector<DoubleDouble>> output;  // positions of the hand, then of the masses [m]: size + 1 coefficients, the last of u
  bool handJumps = false;                         // the control reaches the hand's position at once
  bool handVelocityJumps = false;
};

/// Criteria 1, 4, 5, 6 and the hand-crackle variant, with any damping.
ControlProblem makeControlProblem(const LineObject& object, Criterion criterion, double distance);

}  // namespace reachlab::predict
