#include "sim/dynamics/hand/hand_segment.h"

#include <gtest/gtest.h>

#include "sim/dynamics/hand/hand_function.h"
#include "tests/dynamics/held_segment.h"

namespace reachlab::dynamics {
namespace {

/// The k-th coefficient of every component is another number.
HandSegment segmentOf(int degree) {
  HandSegment s;
  s.degree = degree;
  for (int k = 0; k <= degree; ++k) {
    s.position[k] = {0.3 + 0.1 * k, -0.2 + 0.05 * k * k, 0.7 - 0.2 * k};
    s.velocity[k] = {1.1 - 0.3 * k, 0.4 + 0.2 * k, 0.05 * k * k - 0.6};
  }
  return s;
}
Vec3 sumOfPowers(const std::array<Vec3, HandSegment::kMaxDegree + 1>& c, double s) {
  Vec3 sum;
  for (int k = 0; k <= HandSegment::kMaxDegree; ++k) sum += std::pow(s, k) * c[k];
  return sum;
}

TEST(HandSegment, IsAPolynomialOfItsDegreeInPlaceAndInVelocity) {
  for (int degree = 0; degree <= HandSegment::kMaxDegree; ++degree) {
    const HandSegment s = segmentOf(degree);
    for (const double at : {0.0, 0.3, 1.0}) {
      const HandSample sample = sampleAt(s, at);
      EXPECT_LT(norm(sample.position - sumOfPowers(s.position, at)), 1e-14) << degree;
      EXPECT_LT(norm(sample.velocity - sumOfPowers(s.velocity, at)), 1e-14) << degree;
      EXPECT_TRUE(sample.valid);
    }
    EXPECT_EQ(startOf(s).position, s.position[0]);
    EXPECT_EQ(startOf(s).velocity, s.velocity[0]);
    EXPECT_LT(norm(endOf(s).position - sumOfPowers(s.position, 1)), 1e-14) << degree;
    EXPECT_LT(norm(endOf(s).velocity - sumOfPowers(s.velocity, 1)), 1e-14) << degree;
    EXPECT_TRUE(startOf(s).valid && endOf(s).valid);
  }
}

// The error of the best choice of eight points: dt^8/(8! 2^15) of a sine's eighth derivative, times 2 for the ends.
TEST(HandFunction, ASmoothHandIsFollowedToItsEighthDerivative) {
  const auto hand = [](double t) { return HandSample{{std::sin(t), std::cos(t), std::sin(2 * t)}, {std::cos(t), -std::sin(t), 0}, true}; };
  const double dt = 0.5;
  const HandSegment made = makeSegment(hand, 1, dt);
  double worst = 0;
  for (int i = 0; i <= 100; ++i) {
    const double s = i / 100.0;
    worst = std::max(worst, std::abs(sampleAt(made, s).position.x - std::sin(1 + s * dt)));
    EXPECT_NEAR(sampleAt(made, s).velocity.x, std::cos(1 + s * dt), 1e-11);
    EXPECT_NEAR(sampleAt(made, s).velocity.y, -std::sin(1 + s * dt), 1e-11);
  }
  EXPECT_LT(worst, 2 * std::pow(dt, 8) / (40320.0 * 32768)) << "points elsewhere would err more";
}

}  // namespace
}  // namespace reachlab::dynamics
