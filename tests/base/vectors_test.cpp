#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "base/math/fused.h"
#include "base/math/lanes.h"
#include "base/math/vec3.h"

namespace reachlab {
namespace {

constexpr Vec3 kA{2, -3, 5}, kB{7, 11, -13};

TEST(Vec3, ItsOperatorsWorkOnEachComponent) {
  Vec3 v = kA;
  EXPECT_EQ(v += kB, (Vec3{9, 8, -8}));
  EXPECT_EQ(v -= Vec3({1, 2, 4}), (Vec3{8, 6, -12}));
  EXPECT_EQ(v *= 0.5, (Vec3{4, 3, -6}));
  EXPECT_EQ(kA + kB, (Vec3{9, 8, -8}));
  EXPECT_EQ(kA - kB, (Vec3{-5, -14, 18}));
  EXPECT_EQ(-kA, (Vec3{-2, 3, -5}));
  EXPECT_EQ(3 * kA, (Vec3{6, -9, 15}));
  EXPECT_EQ(kA * 3, (Vec3{6, -9, 15}));
  EXPECT_EQ(kA / 4, (Vec3{0.5, -0.75, 1.25}));
  EXPECT_EQ(Vec3{}, (Vec3{0, 0, 0}));
}

TEST(Vec3, ProductsAreThoseOfGeometry) {
  EXPECT_EQ(dot(kA, kB), 14 - 33 - 65);
  const Vec3 across = cross(kA, kB);
  EXPECT_EQ(across, (Vec3{39 - 55, 35 + 26, 22 + 21}));
  EXPECT_EQ(dot(across, kA), 0);
  EXPECT_EQ(dot(across, kB), 0);
  EXPECT_EQ(norm(Vec3{2, -3, 6}), 7);
}

TEST(Vec3, IsFiniteWhereEachComponentIs) {
  EXPECT_TRUE(isFinite(kA));
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(isFinite({bad, 1, 1}));
    EXPECT_FALSE(isFinite({1, bad, 1}));
    EXPECT_FALSE(isFinite({1, 1, bad}));
  }
}

// (1 + e)(1 - e) - 1 = -e^2, which a product that is rounded on its own loses.
TEST(Fused, RoundsOnce) {
  constexpr double kE = 0x1p-30;
  EXPECT_EQ(mulAdd(1 + kE, 1 - kE, -1.0), -kE * kE);
  EXPECT_EQ(mulAdd(3, kA, kB), (Vec3{13, 2, 2}));
  EXPECT_EQ(mulAdd(kA, kB, 100.0), 16);
  EXPECT_EQ(fusedDot(kA, kB), -84);
  EXPECT_EQ(fusedDot({1 + kE, 0, -1}, {1 - kE, 5, 1}), -kE * kE);
  EXPECT_EQ(fusedDot({0, 1 + kE, -1}, {5, 1 - kE, 1}), -kE * kE);
}

template <class L>
class LanesOf : public testing::Test {};
using Widths = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 4>, std::integral_constant<int, 8>>;
TYPED_TEST_SUITE(LanesOf, Widths);

TYPED_TEST(LanesOf, DoToEachNumberWhatIsDoneToOne) {
  constexpr int kWidth = TypeParam::value;
  using L = Lanes<kWidth>;
  static_assert(sizeof(L) == kWidth * sizeof(double) && sizeof(LaneMarks<kWidth>) == sizeof(L));
  double from[kWidth + 1], to[kWidth + 1];
  for (int i = 0; i <= kWidth; ++i) from[i] = (i % 2 == 0 ? -1.5 : 2.0) * (i + 1), to[i] = 99;
  const L x = loadLanes<L>(from), seven = broadcast<L>(7);
  storeLanes(magnitude(x), to);
  EXPECT_EQ(to[kWidth], 99) << "and not beyond them";
  const L sum = mulAdd(x, seven, x), scaled = mulAdd(0.5, x, seven);
  for (int i = 0; i < kWidth; ++i) {
    EXPECT_EQ(to[i], std::abs(from[i])) << i;
    EXPECT_EQ(sum[i], 8 * from[i]) << i;
    EXPECT_EQ(scaled[i], 0.5 * from[i] + 7) << i;
  }
  EXPECT_FALSE(std::signbit(broadcast<L>(0.0)[0]));
  EXPECT_TRUE(std::signbit(broadcast<L>(-0.0)[kWidth - 1]));
}

TYPED_TEST(LanesOf, AreAskedForAnyMarkWhereverItStands) {
  constexpr int kWidth = TypeParam::value;
  EXPECT_FALSE(anyLane(LaneMarks<kWidth>{}));
  for (int i = 0; i < kWidth; ++i) {
    LaneMarks<kWidth> marks{};
    marks[i] = -1;
    EXPECT_TRUE(anyLane(marks)) << i;
  }
}

TYPED_TEST(LanesOf, AreAllZeroOnlyWithoutAnythingInfinite) {
  constexpr int kWidth = TypeParam::value;
  using L = Lanes<kWidth>;
  EXPECT_TRUE(allZero(broadcast<L>(3) * 0.0));
  EXPECT_TRUE(allZero(broadcast<L>(-3) * 0.0));
  for (int i = 0; i < kWidth; ++i)
    for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), std::nan("")}) {
      L x = broadcast<L>(3);
      x[i] = bad;
      EXPECT_FALSE(allZero(x * 0.0)) << i;
    }
}

TEST(Lanes, AreAsManyAsHoldTheCount) {
  EXPECT_EQ(lanesFor<4>(0), 0);
  EXPECT_EQ(lanesFor<4>(1), 1);
  EXPECT_EQ(lanesFor<4>(4), 1);
  EXPECT_EQ(lanesFor<4>(5), 2);
  EXPECT_EQ(kBatchLanes, 8);
}

}  // namespace
}  // namespace reachlab
