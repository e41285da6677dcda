#pragma once
#include <map>
#include <optional>
#include <vector>

#include "constraints/formula/expression.h"

namespace reachlab::constraints {

/// A polynomial with numbers as coefficients. Its indeterminates are graph nodes that are not sums or products (u, sin(u), sqrt(1 - u^2)
/// …). The identities sin^2 + cos^2 = 1, cosh^2 - sinh^2 = 1, sqrt(a)^2 = a and abs(a)^2 = a^2 are applied. An expression that vanishes
/// identically by them therefore keeps no terms except rounding.
class Polynomial {
 public:
  using Monomial = std::map<int, int>;  // node to exponent
  static constexpr std::size_t kMaxTerms = 4000;

  /// Nothing where it would have more than kMaxTerms terms.
  static std::optional<Polynomial> of(const ExpressionGraph& graph, int node, const double* shape);
  static Polynomial constant(double value);

  Polynomial& operator+=(const Polynomial& other);
  Polynomial& operator*=(double factor);
  std::optional<Polynomial> times(const Polynomial& other, const ExpressionGraph& graph, const double* shape) const;
  /// Largest |coefficient|.
  double largest() const;

 private:
  /// Rewrites squares by the identities above.
  std::optional<Polynomial> reduced(const ExpressionGraph& graph, const double* shape) const;
  std::map<Monomial, double> terms_;
};

}  // namespace reachlab::constraints
