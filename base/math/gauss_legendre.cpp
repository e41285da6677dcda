#include "base/math/gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace reachlab {

// Newton on P_n from Tricomi's estimate of its roots (Abramowitz and Stegun 22.16.6), in extended precision so that nodes and
// weights are right to the last bit of a double.
GaussRule makeGaussRule(int count) {
  using Wide = long double;
  constexpr int kPasses = 8;  // the error squares with each from about 1e-3
  GaussRule rule;
  rule.node.resize(static_cast<size_t>(count)), rule.weight.resize(static_cast<size_t>(count));
  for (int i = 0; i < (count + 1) / 2; ++i) {
    Wide x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    Wide slope = 1.0;
    for (int pass = 0; pass < kPasses; ++pass) {
      Wide before = 0.0, p = 1.0;
      for (int k = 1; k <= count; ++k) {
        const Wide next = (Wide(2.0 * k - 1) * x * p - Wide(k - 1.0) * before) / Wide(1.0 * k);
        before = p, p = next;
      }
      slope = Wide(1.0 * count) * (x * p - before) / (x * x - Wide(1.0));
      x -= p / slope;
    }
    const auto lo = static_cast<size_t>(i), hi = static_cast<size_t>(count - 1 - i);
    rule.node[lo] = static_cast<double>(-x), rule.node[hi] = static_cast<double>(x);
    rule.weight[lo] = rule.weight[hi] = static_cast<double>(Wide(2.0) / ((Wide(1.0) - x * x) * slope * slope));
  }
  return rule;
}

const GaussRule& gaussRule16() {
  static const GaussRule rule = makeGaussRule(16);
  return rule;
}

}  // namespace reachlab
