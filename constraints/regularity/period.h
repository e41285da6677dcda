#pragma once
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// After which a curve's formula repeats itself: turn + rest, for 2 pi has more digits than a double. 0: none is proved.
struct Period {
  double turn = 0, rest = 0;
};
/// Shown on the formula's graph: phi stands only in sines, cosines and tangents of a phi + b, and the a have a common measure (at most
/// 64 of the smallest). Allocates; not for the haptic thread.
Period findPeriod(const Constraint& curve);

}  // namespace reachlab::constraints
