#include "sim/predict/numerics/hyper_dual.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

namespace reachlab::predict {
namespace {

using Jet = HyperDual<2>;

// (1 + x y) / (x - 2 y) at (4, 1), where d = x - 2 y = 2 and the quotient q = 2.5. By hand from q d = 1 + x y.
TEST(HyperDual, AQuotientHasItsFirstAndSecondDerivatives) {
  const Jet x = Jet::variable(0, 4), y = Jet::variable(1, 1);
  double q, first[2], second[4];
  ((1.0 + x * y) / (x + -2.0 * y)).store(&q, first, second);
  EXPECT_DOUBLE_EQ(q, 2.5);
  EXPECT_DOUBLE_EQ(first[0], -0.75);  // (y - q) / d
  EXPECT_DOUBLE_EQ(first[1], 4.5);    // (x + 2 q) / d
  EXPECT_DOUBLE_EQ(second[0], 0.75);  // -2 q_x / d
  EXPECT_DOUBLE_EQ(second[1], -2.5);  // (1 + 2 q_x - q_y) / d
  EXPECT_DOUBLE_EQ(second[2], -2.5);
  EXPECT_DOUBLE_EQ(second[3], 9);  // 4 q_y / d
}

// Of f(x, y, z) with its variables shared among jets: f against differences of jets, first derivatives against those of f, second ones
// against those of the first.
using Three = HyperDual<3>;
void expectDerivatives(const std::function<Three(const Three&, const Three&, const Three&)>& f, const std::array<double, 3>& at) {
  const auto jetAt = [&](const std::array<double, 3>& q) {
    return f(Three::variable(0, q[0]), Three::variable(1, q[1]), Three::variable(2, q[2]));
  };
  double value, first[3], second[9];
  jetAt(at).store(&value, first, second);
  constexpr double h = 1e-5;
  for (int i = 0; i < 3; ++i) {
    auto before = at, after = at;
    before[i] -= h, after[i] += h;
    double v0, v1, g0[3], g1[3], hessian[9];
    jetAt(before).store(&v0, g0, hessian);
    jetAt(after).store(&v1, g1, hessian);
    EXPECT_NEAR(first[i], (v1 - v0) / (2 * h), 1e-7 * (1 + std::abs(first[i]))) << i;
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(second[3 * i + j], (g1[j] - g0[j]) / (2 * h), 1e-7 * (1 + std::abs(second[3 * i + j]))) << i << j;
      EXPECT_EQ(second[3 * i + j], second[3 * j + i]);
    }
  }
}

TEST(HyperDual, EveryFunctionHasItsFirstAndSecondDerivatives) {
  const std::array<double, 3> at{0.7, -1.3, 0.4};
  expectDerivatives([](const Three& x, const Three& y, const Three& z) { return x * y * z + 2.0 * x - y * y; }, at);
  expectDerivatives([](const Three& x, const Three& y, const Three& z) { return -(x - y) / (z * z + 1.5); }, at);
  expectDerivatives([](const Three& x, const Three& y, const Three& z) { return sin(x * y) + cos(y + 3.0 * z); }, at);
  expectDerivatives([](const Three& x, const Three& y, const Three& z) { return acos(0.3 * x + 0.2 * y * z); }, at);
  for (const auto& place : {std::array{0.7, -1.3, 0.4}, {-1.5, 0.3, 0.2}, {-0.4, -0.9, 0.1}, {1.1, 1.1, 0}, {0.3, 2, -1}})
    expectDerivatives([](const Three& x, const Three& y, const Three& z) { return atan2(y + 0.1 * z * z, x + 0.2 * y * z); }, place);
}

TEST(HyperDual, ItsValuesAreThoseOfTheFunctions) {
  const Three x = Three::variable(0, 0.6), y = Three::variable(1, -0.8);
  EXPECT_EQ(sin(x).value, std::sin(0.6));
  EXPECT_EQ(cos(x).value, std::cos(0.6));
  EXPECT_EQ(acos(x).value, std::acos(0.6));
  EXPECT_EQ(atan2(y, x).value, std::atan2(-0.8, 0.6));
  EXPECT_EQ(atan2(x, y).value, std::atan2(0.6, -0.8));
  EXPECT_EQ((x - y).value, 1.4);
  EXPECT_EQ((-x).value, -0.6);
  EXPECT_EQ(Three().value, 0);
}

}  // namespace
}  // namespace reachlab::predict
