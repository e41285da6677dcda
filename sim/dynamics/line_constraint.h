#pragma once
#include "constraints/constraint.h"

namespace reachlab {

/// The paper's line (14), r(phi) = x_B + phi/(2 pi) (x_E - x_B) along x, without a formula.
Constraint makeLine(const ConstraintSpec& spec);

}  // namespace reachlab
