#include "sim/dynamics/exact/chain_modes.h"

#include <gtest/gtest.h>

#include "sim/dynamics/exact/oscillator_core.h"

namespace reachlab::dynamics {
namespace {

ObjectModel chain(const std::vector<double>& masses, double stiffness, double hand) {
  ObjectModel m;
  m.kind = experiment::ObjectKind::Chain;
  m.mass = masses;
  for (std::size_t i = 0; i + 1 < masses.size(); ++i) m.stiffness.push_back(stiffness * (1 + 0.3 * static_cast<double>(i % 3)));
  m.damping.assign(m.stiffness.size(), 0);
  m.handStiffness.assign(masses.size(), 0), m.handDamping.assign(masses.size(), 0);
  m.handStiffness[0] = hand;
  return m;
}
/// Springs to neighbours and, where coupled, of mass 1 to the hand.
Eigen::MatrixXd matrixOf(const ObjectModel& m, const std::vector<double>& spring, double hand, double all) {
  const int n = m.count();
  Eigen::MatrixXd k = all * Eigen::MatrixXd::Identity(n, n);
  k(0, 0) += hand;
  for (int i = 0; i + 1 < n; ++i) k(i, i) += spring[i], k(i + 1, i + 1) += spring[i], k(i, i + 1) -= spring[i], k(i + 1, i) -= spring[i];
  return k;
}

TEST(ChainModes, DiagonaliseMassesAndSprings) {
  for (const std::vector<double>& masses : {std::vector<double>{0.7}, {0.5, 2}, {0.5, 0.8, 0.3}, {1, 0.2, 0.6, 0.9, 0.4, 1.5, 0.3}})
    for (const bool coupled : {true, false}) {
      const ObjectModel m = chain(masses, 200, 90);
      const ChainModes modes = computeModes(m, coupled);
      const int n = m.count();
      Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n);
      for (int i = 0; i < n; ++i) mass(i, i) = masses[i];
      const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n), k = matrixOf(m, m.stiffness, coupled ? 90 : 0, 0);
      EXPECT_LT((modes.toMasses.transpose() * mass * modes.toMasses - one).norm(), 1e-13) << n;
      EXPECT_LT((modes.toModes * modes.toMasses - one).norm(), 1e-13) << n;
      const Eigen::MatrixXd squares = modes.toMasses.transpose() * k * modes.toMasses;
      ASSERT_EQ(modes.squaredFrequency.size(), masses.size());
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) EXPECT_NEAR(squares(i, j), i == j ? modes.squaredFrequency[i] : 0, 1e-10) << n << ": " << i << j;
      for (const double square : modes.squaredFrequency) EXPECT_GE(square, 0);
      const double slowest = *std::min_element(modes.squaredFrequency.begin(), modes.squaredFrequency.end());
      EXPECT_EQ(slowest < 1e-12, !coupled) << "let go it is free as a whole";
    }
}

// Two masses: the roots of a quadratic equation, the slower by the product of both.
TEST(ChainModes, ASlowModeKeepsItsDigitsBesideAFastOne) {
  const long double m1 = 0.5L, m2 = 2, k = 1e8L, hand = 6;
  const ObjectModel m = chain({0.5, 2}, 1e8, 6);
  const long double sum = (hand + k) / m1 + k / m2, product = hand * k / (m1 * m2);
  const long double fast = (sum + std::sqrt(sum * sum - 4 * product)) / 2;
  std::vector<double> squares = computeModes(m, true).squaredFrequency;
  std::sort(squares.begin(), squares.end());
  EXPECT_NEAR(squares[0] / static_cast<double>(product / fast), 1, 1e-11);
  EXPECT_NEAR(squares[1] / static_cast<double>(fast), 1, 1e-13);
}

TEST(ChainModes, DampingIsProportionalWhereTheModesBearIt) {
  ObjectModel m = chain({0.5, 0.5, 0.5, 0.5}, 200, 90);
  EXPECT_TRUE(canBeModal(m)) << "none";
  m.viscosity = 0.8;
  EXPECT_TRUE(canBeModal(m)) << "a medium about equal masses";
  for (const double damping : computeModes(m, true).damping) EXPECT_NEAR(damping, 1.6, 1e-13);
  for (std::size_t i = 0; i < 3; ++i) m.damping[i] = 0.01 * m.stiffness[i];
  EXPECT_FALSE(canBeModal(m)) << "the hand's spring has no damper";
  EXPECT_FALSE(computeModes(m, true).proportional);
  EXPECT_TRUE(computeModes(m, false).proportional) << "let go it has no spring";
  m.handDamping[0] = 0.01 * 90;
  EXPECT_TRUE(canBeModal(m)) << "in proportion to every spring";
  const ChainModes modes = computeModes(m, true);
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(modes.damping[j], 1.6 + 0.01 * modes.squaredFrequency[j], 1e-12);
  m.damping[1] *= 1 + 1e-9;
  EXPECT_FALSE(canBeModal(m));
  m.damping[1] = 0.01 * m.stiffness[1];
  m.mass[2] = 0.6;
  EXPECT_FALSE(canBeModal(m)) << "a medium about unequal masses";
  m.viscosity = 0;
  EXPECT_TRUE(canBeModal(m));
  m.kind = experiment::ObjectKind::Parallel;
  m.viscosity = 0.8;
  EXPECT_TRUE(canBeModal(m)) << "masses side by side are modes themselves";
}

}  // namespace
}  // namespace reachlab::dynamics
