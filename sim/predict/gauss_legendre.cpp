#include "sim/predict/gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace reachlab {

// Newton on P_n from Tricomi's estimate of its roots (Abramowitz and Stegun 22.16.6), in extended precision so that nodes and weights
// are right to the last bit of a double.
GaussRule makeGaussRule(int count) {
  GaussRule rule;
  rule.node.resize(static_cast<size_t>(count)), rule.weight.resize(static_cast<size_t>(count));
  const long double n = count;
  for (int i = 0; i < (count + 1) / 2; ++i) {
    long double x = std::cos(std::numbers::pi_v<long double> * (i + 0.75L) / (n + 0.5L));
    long double slope = 1;
    for (int pass = 0; pass < 8; ++pass) {
      long double p0 = 1, p1 = x;
      for (int k = 2; k <= count; ++k) {
        const long double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1, p1 = p2;
      }
      if (count == 1) p0 = 1, p1 = x;
      slope = n * (x * p1 - p0) / (x * x - 1);
      const long double step = p1 / slope;
      x -= step;
      if (std::abs(step) < 1e-19L) break;
    }
    const auto lo = static_cast<size_t>(i), hi = static_cast<size_t>(count - 1 - i);
    rule.node[lo] = static_cast<double>(-x), rule.node[hi] = static_cast<double>(x);
    rule.weight[lo] = rule.weight[hi] = static_cast<double>(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

const GaussRule& gaussRule16() {
  static const GaussRule rule = makeGaussRule(16);
  return rule;
}

}  // namespace reachlab
