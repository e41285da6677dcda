#include "sim/dynamics/hand/hand_function.h"

#include <cmath>
#include <numbers>

#include "base/math/elementary.h"

namespace reachlab::dynamics {
namespace {

constexpr int kPoints = HandSegment::kMaxDegree + 1;
using NodeMatrix = std::array<std::array<double, kPoints>, kPoints>;

struct Nodes {
  std::array<double, kPoints> s{};
  NodeMatrix coefficients{};  // c_k = sum_j coefficients[k][j] p(s_j)
};

/// Monomial coefficients of the Lagrange polynomials at the nodes, multiplied out in long double.
Nodes computeNodes() {
  Nodes nodes;
  std::array<long double, kPoints> s{};
  for (int j = 0; j < kPoints; ++j) {
    nodes.s[j] = 0.5 - 0.5 * elementary::cos(std::numbers::pi * j / (kPoints - 1));
    s[j] = nodes.s[j];
  }
  for (int j = 0; j < kPoints; ++j) {
    std::array<long double, kPoints + 1> product{1};
    int degree = 0;
    for (int m = 0; m < kPoints; ++m) {
      if (m == j) continue;
      for (int k = degree + 1; k >= 0; --k)
        product[k] = ((k > 0 ? product[k - 1] : 0) - s[m] * (k <= degree ? product[k] : 0)) / (s[j] - s[m]);
      ++degree;
    }
    for (int k = 0; k < kPoints; ++k) nodes.coefficients[k][j] = static_cast<double>(product[k]);
  }
  return nodes;
}

}  // namespace

HandSegment makeSegment(const HandFunction& hand, double t0, double dt) {
  static const Nodes nodes = computeNodes();
  HandSegment segment;
  segment.degree = HandSegment::kMaxDegree;
  std::array<HandSample, kPoints> samples;
  for (int j = 0; j < kPoints; ++j) samples[j] = hand(t0 + dt * nodes.s[j]);
  // Differences from the first point: their rounding is of the size of the motion, not of the place.
  for (int k = 1; k < kPoints; ++k)
    for (int j = 1; j < kPoints; ++j) {
      segment.position[k] += nodes.coefficients[k][j] * (samples[j].position - samples[0].position);
      segment.velocity[k] += nodes.coefficients[k][j] * (samples[j].velocity - samples[0].velocity);
    }
  segment.position[0] = samples[0].position;
  segment.velocity[0] = samples[0].velocity;
  return segment;
}

}  // namespace reachlab::dynamics
