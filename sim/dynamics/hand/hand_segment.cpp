#include "sim/dynamics/hand/hand_segment.h"

namespace reachlab::dynamics {
namespace {

/// p(s0 + width x) as a polynomial in x: Horner's shift, then powers of the width.
HandSegment::Coefficients shifted(HandSegment::Coefficients c, int degree, double s0, double width) noexcept {
  for (int i = 0; i < degree; ++i)
    for (int k = degree - 1; k >= i; --k) c[k] += s0 * c[k + 1];
  double power = 1;
  for (int k = 1; k <= degree; ++k) c[k] *= power *= width;
  return c;
}

}  // namespace

HandSegment part(const HandSegment& whole, double s0, double s1) noexcept {
  return {whole.degree, shifted(whole.position, whole.degree, s0, s1 - s0), shifted(whole.velocity, whole.degree, s0, s1 - s0)};
}

}  // namespace reachlab::dynamics
