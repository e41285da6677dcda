#include "sim/environment/force_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/math/minimum_jerk.h"
#include "base/ticks.h"

namespace reachlab::environment {
namespace {

using namespace experiment;

constexpr double kPi = std::numbers::pi;
const Vec3 kReachStart{}, kReachTarget{0, 0, -0.1};

ForceField fieldOf(const HandForce& force, const Arm& arm = {}) { return {{force}, arm, kReachStart, kReachTarget}; }

/// B of a curl field: the force stands at right angles to the velocity in the horizontal plane.
ViscousForce curl(double b) { return {{{{0, 0, b}, {0, 0, 0}, {-b, 0, 0}}}}; }

HandTick moving(const Vec3& position, const Vec3& velocity) { return {true, true, position, velocity}; }

void letGrow(ForceField& field, int ticks = ForceField::kRampTicks) {
  for (int i = 0; i < ticks; ++i) field.step(moving(kReachStart, {}));
}

TEST(ForceField, NothingActsWithoutForcesOrBeforeTheTrial) {
  ForceField none({}, {}, kReachStart, kReachTarget);
  EXPECT_EQ(none.step(moving({1, 2, 3}, {1, 2, 3})), Vec3{});
  ForceField field = fieldOf({curl(13)});
  EXPECT_EQ(field.step({false, false, {}, {1, 0, 0}}), Vec3{});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(field.step({true, false, {}, {1, 0, 0}}), Vec3{}) << "acts from movement onset only";
}

TEST(ForceField, AnAntisymmetricFieldDoesNoWork) {
  ForceField field = fieldOf({curl(13)});
  letGrow(field);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 v{std::sin(0.1 * i), std::cos(0.7 * i), std::sin(0.3 * i + 1)};
    const Vec3 force = field.step(moving({}, v));
    EXPECT_NEAR(norm(force), 13 * std::hypot(v.x, v.z), 1e-12);
    EXPECT_LT(std::abs(dot(force, v)), 1e-12);
  }
}

TEST(ForceField, AnElasticFieldPullsToItsCentreOrToTheStart) {
  const SquareMatrix<3> k{{{100, 20, 0}, {20, 50, 0}, {0, 0, 10}}};
  ForceField toStart = fieldOf({ElasticForce{k, {}}}), toCentre = fieldOf({ElasticForce{k, Vec3{0, 0.1, 0}}});
  for (int i = 0; i < ForceField::kRampTicks; ++i) toStart.step(moving({}, {})), toCentre.step(moving({}, {}));
  const Vec3 near = toStart.step(moving({0.1, 0.2, 0.3}, {})), centred = toCentre.step(moving({0.1, 0.2, 0.3}, {}));
  EXPECT_LT(norm(near - Vec3{-14, -12, -3}), 1e-12);
  EXPECT_LT(norm(centred - Vec3{-12, -7, -3}), 1e-12);
}

TEST(ForceField, AChannelHoldsAHandThatIsPushedAcrossIt) {
  const ChannelForce law;
  ForceField field = fieldOf({law, ForceWhen::Trial});
  constexpr double push = 5, mass = 1;
  Vec3 position, velocity, force;
  for (int i = 0; i < 600; ++i) field.step({true, false, {}, {}});
  for (int i = 0; i < 5000; ++i) {
    force = field.step({true, true, position, velocity});
    velocity += (kTickSeconds / mass) * (force + Vec3{push, 0, 0});
    position += kTickSeconds * velocity;
    position.z -= 1e-5;  // along the channel nothing holds the hand
  }
  EXPECT_LE(position.x, push / law.stiffness + 1e-9);
  EXPECT_NEAR(position.x, push / law.stiffness, 1e-9);
  EXPECT_NEAR(force.x, -push, 1e-6);
  EXPECT_EQ(force.z, 0);
  EXPECT_FALSE(field.channelBroken());
}

TEST(ForceField, AChannelIsFreeWithinItsWidth) {
  ForceField field = fieldOf({ChannelForce{.halfWidth = 0.005}, ForceWhen::Trial});
  letGrow(field, 600);
  EXPECT_EQ(field.step(moving({0.004, 0, -0.05}, {1, 0, 0})), Vec3{});
  EXPECT_NEAR(field.step(moving({0.006, 0, -0.05}, {})).x, -1, 1e-9);
  EXPECT_NEAR(field.step(moving({0.006, 0, -0.05}, {0.1, 0, 0})).x, -2.5, 1e-9);
}

TEST(ForceField, ABrokenChannelLetsGoUntilTheNextTrial) {
  ForceField field = fieldOf({ChannelForce{}, ForceWhen::Trial});
  letGrow(field, 600);
  double before = norm(field.step(moving({0.0299, 0, 0}, {})));
  EXPECT_FALSE(field.channelBroken());
  for (int i = 0; i <= ForceField::kRampTicks; ++i) {
    const double now = norm(field.step(moving({0.0301, 0, 0}, {})));
    EXPECT_LT(std::abs(now - before), 30.1 / ForceField::kRampTicks + 0.2001);
    before = now;
  }
  EXPECT_TRUE(field.channelBroken());
  EXPECT_EQ(field.step(moving({0.01, 0, 0}, {})), Vec3{}) << "back inside, the walls stay away";
  field.reset();
  EXPECT_FALSE(field.channelBroken());
  letGrow(field, 600);
  EXPECT_NEAR(field.step(moving({0.01, 0, 0}, {})).x, -10, 1e-9);
}

TEST(ForceField, EveryForceGrowsWithoutAStep) {
  const ViscousForce viscous = curl(13);
  const ElasticForce elastic{{{{100, 0, 0}, {0, 100, 0}, {0, 0, 100}}}, {}};
  for (const auto& [force, ticks] :
       {std::pair{HandForce{viscous}, 20}, std::pair{HandForce{elastic}, 20}, std::pair{HandForce{viscous, ForceWhen::Trial}, 20},
        std::pair{HandForce{ChannelForce{}, ForceWhen::Trial}, 500}}) {
    ForceField field = fieldOf(force);
    const HandTick hand = moving({0.01, 0, 0.02}, {0.3, 0, 0.1});
    Vec3 last;
    double largest = 0;
    for (int i = 0; i < 600; ++i) {
      const Vec3 now = field.step(hand);
      largest = std::max(largest, norm(now - last));
      last = now;
    }
    EXPECT_GT(norm(last), 1);
    EXPECT_NEAR(largest, norm(last) / ticks, 1e-9);
  }
}

TEST(ForceField, APulseGivesItsMomentumAtItsInstant) {
  for (const bool byDistance : {false, true}) {
    PulseForce law;
    law.force = {6, 0, -2};
    if (byDistance) law.at.distance = 0.03;
    else law.at.onset = 0.1;
    ForceField field = fieldOf({law});
    for (int trial = 0; trial < 2; ++trial) {
      field.reset();
      for (int i = 0; i < 50; ++i) EXPECT_EQ(field.step({true, false, {0, 0, -1}, {}}), Vec3{}) << "no movement yet";
      Vec3 momentum;
      int first = -1;
      for (int i = 0; i < 400; ++i) {
        const Vec3 force = field.step(moving({0, 0, -0.0003 * i}, {}));
        if (first < 0 && norm(force) > 0) first = i;
        momentum += kTickSeconds * force;
      }
      EXPECT_EQ(first, 101) << "the first tick of the rise has zero force";
      EXPECT_LT(norm(momentum - (law.duration - law.rise) * law.force), 1e-12);
    }
  }
}

// Shadmehr & Mussa-Ivaldi (1994), J. Neurosci. 14(5): x to the right, y forward; shoulder at 15 and elbow at 100 degrees, both absolute.
struct Shadmehr {
  static constexpr double kB[2][2] = {{-10.1, -11.2}, {-11.2, 11.1}};
  Arm arm;
  std::array<double, 2> angles{15 * kPi / 180, 100 * kPi / 180};
  Vec3 hand;
  Shadmehr() {
    arm.length = {0.33, 0.34};
    arm.shoulder = {0, 0};
    hand = {0.33 * std::cos(angles[0]) + 0.34 * std::cos(angles[1]), 0, -(0.33 * std::sin(angles[0]) + 0.34 * std::sin(angles[1]))};
  }
  HandForce viscous() const { return {ViscousForce{{{{kB[0][0], 0, -kB[0][1]}, {0, 0, 0}, {-kB[1][0], 0, kB[1][1]}}}}}; }
  HandForce joint() const { return {JointViscousForce{{{{1.66, 0.64}, {0.64, -1.54}}}}}; }
};

TEST(ForceField, TheArmsAnglesAreThoseOfItsHand) {
  const Shadmehr published;
  const auto angles = absoluteAngles(published.arm, published.hand.x, -published.hand.z);
  EXPECT_NEAR(angles[0], published.angles[0], 1e-12);
  EXPECT_NEAR(angles[1], published.angles[1], 1e-12);
  Arm left = published.arm;
  left.elbowLeft = true;
  const auto other = absoluteAngles(left, published.hand.x, -published.hand.z);
  EXPECT_GT(other[0], other[1]);
  EXPECT_NEAR(0.33 * std::cos(other[0]) + 0.34 * std::cos(other[1]), published.hand.x, 1e-12);
  EXPECT_FALSE(std::isfinite(absoluteAngles(published.arm, 1, 1)[0])) << "out of reach";
}

TEST(ForceField, ThePublishedJointFieldIsTheViscousOneAtThatPosture) {
  const Shadmehr published;
  const SquareMatrix<2> j = absoluteJacobian(published.arm, published.angles);
  const auto entry = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 2; ++k) sum += j[i][a] * Shadmehr::kB[i][k] * j[k][b];
    return sum;
  };
  EXPECT_NEAR(entry(0, 0), 1.664, 5e-4);
  EXPECT_NEAR(entry(0, 1), 0.641, 5e-4);
  EXPECT_NEAR(entry(1, 0), 0.641, 5e-4);
  EXPECT_NEAR(entry(1, 1), -1.536, 5e-4);
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / static_cast<double>(a.size()), mb += b[i] / static_cast<double>(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
    ab += (a[i] - ma) * (b[i] - mb);
  }
  return ab / std::sqrt(aa * bb);
}

// Printed: 0.99. Recomputed as the mean of the two axes' coefficients it is 0.988; over all components together it is 0.986.
TEST(ForceField, ThePublishedFieldsCorrelateOverReachesInEightDirections) {
  const Shadmehr published;
  ForceField viscous = fieldOf(published.viscous(), published.arm), joint = fieldOf(published.joint(), published.arm);
  for (int i = 0; i < ForceField::kRampTicks; ++i) viscous.step(moving(published.hand, {})), joint.step(moving(published.hand, {}));
  std::array<std::vector<double>, 2> a, b;
  for (int direction = 0; direction < 8; ++direction) {
    const Vec3 way{0.1 * std::cos(direction * kPi / 4), 0, -0.1 * std::sin(direction * kPi / 4)};
    for (int i = 0; i <= 500; ++i) {
      const double x = i / 500.0;
      const HandTick hand = moving(published.hand + minimumJerk(x) * way, (minimumJerkRate(x) / 0.5) * way);
      const Vec3 one = viscous.step(hand), two = joint.step(hand);
      a[0].push_back(one.x), a[1].push_back(one.z);
      b[0].push_back(two.x), b[1].push_back(two.z);
    }
  }
  EXPECT_NEAR((correlation(a[0], b[0]) + correlation(a[1], b[1])) / 2, 0.988, 1e-3);
}

}  // namespace
}  // namespace reachlab::environment
