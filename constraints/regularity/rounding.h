#pragma once
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// [m] A bound to first order of the effect of the formula's roundings on r, at phi or at u, v. Each operation rounds its result and passes
/// on the errors of its operands (running error analysis: Higham, Accuracy and Stability of Numerical Algorithms, 3.3). phi, u and v
/// themselves count as exact. Large numbers that cancel show here: 1e12 + sin(phi) - 1e12 gives 1e-4. 0 without a formula. It allocates, so
/// it is not for the haptic thread.
double computeRounding(const Constraint& constraint, double first, double second = 0);

}  // namespace reachlab::constraints
