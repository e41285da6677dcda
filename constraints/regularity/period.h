#pragma once
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// The period of a curve's formula: turn + rest, because 2 pi has more digits than a double. It is 0 if no period is proved.
struct Period {
  double turn = 0, rest = 0;
};
/// Proved on the formula's graph: phi occurs only in sines, cosines and tangents of a phi + b. The factors a have a common measure, which
/// is at least 1/64 of the smallest. It allocates, so it is not for the haptic thread.
Period findPeriod(const Constraint& curve);

}  // namespace reachlab::constraints
