#include "sim/predict/numerics/hyper_dual.h"

#include <gtest/gtest.h>

namespace reachlab::predict {
namespace {

using Jet = HyperDual<2>;

// (1 + x y) / (x - 2 y) at (3, 1), where the quotient q = 4: by hand q_x = (y - q)/d, q_y = (x + 2 q)/d with d = x - 2 y = 1, and on.
TEST(HyperDual, AQuotientHasItsFirstAndSecondDerivatives) {
  const Jet x = Jet::variable(0, 3), y = Jet::variable(1, 1);
  double q, first[2], second[4];
  ((1.0 + x * y) / (x + -2.0 * y)).store(&q, first, second);
  EXPECT_DOUBLE_EQ(q, 4);
  EXPECT_DOUBLE_EQ(first[0], -3);
  EXPECT_DOUBLE_EQ(first[1], 11);
  EXPECT_DOUBLE_EQ(second[0], 6);    // -2 q_x / d
  EXPECT_DOUBLE_EQ(second[1], -16);  // (1 + 2 q_x - q_y) / d
  EXPECT_DOUBLE_EQ(second[2], -16);
  EXPECT_DOUBLE_EQ(second[3], 44);  // 4 q_y / d
}

}  // namespace
}  // namespace reachlab::predict
