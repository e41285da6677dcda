#pragma once
#include <array>

#include "constraints/formula/expression.h"

namespace reachlab::constraints {

/// Taylor polynomial in (du, dv), cut off after terms of total degree kMaxDegree: c[place(a, b)] belongs to du^a dv^b.
struct Taylor {
  static constexpr int kMaxDegree = 5, kTerms = (kMaxDegree + 1) * (kMaxDegree + 2) / 2;
  static constexpr int place(int a, int b) { return (a + b) * (a + b + 1) / 2 + b; }
  std::array<double, kTerms> c{};
};

// All below keep terms up to `degree` <= kMaxDegree.
Taylor multiply(const Taylor& x, const Taylor& y, int degree);
/// One operation of the formula language. `exponent` belongs to PowInt. The result is not finite where the operation or a derivative of it
/// has no value. At the kink of abs and the jump of sign the derivatives are those of the graph, with sign(0) = 0.
Taylor apply(Op op, const Taylor& x, const Taylor& y, int exponent, int degree);

}  // namespace reachlab::constraints
