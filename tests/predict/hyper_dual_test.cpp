#include "sim/predict/numerics/hyper_dual.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace reachlab::predict
