#pragma once
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// [m] How far the roundings inside the formula itself may move r at phi, or at u, v: each operation rounds its result and hands on what
/// its operands are off by, to first order (running error analysis: Higham, Accuracy and Stability of Numerical Algorithms, 3.3).
/// phi, u and v themselves count as exact. Large numbers that cancel show here, 1e12 + sin(phi) - 1e12 by 1e-4. 0 without a formula.
/// Allocates; not for the haptic thread.
double computeRounding(const Constraint& constraint, double first, double second = 0);

}  // namespace reachlab::constraints
