#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Lanes of the width, as this level of processor has them, and put together from two halves, as a lower level has them.
template <int Width>
struct Whole {
  static constexpr int kWidth = Width;
  using Numbers = Lanes<Width>;
  using Marks = LaneMarks<Width>;
};
template <class Part>
struct InHalves {
  static constexpr int kWidth = 2 * Part::kWidth;
  using Numbers = lanesDetail::Halves<typename Part::Numbers>;
  using Marks = lanesDetail::Halves<typename Part::Marks>;
};
template <class L>
class LanesOf : public testing::Test {};
using Kinds = testing::Types<Whole<2>, Whole<4>, Whole<8>, InHalves<Whole<2>>, InHalves<Whole<4>>, InHalves<InHalves<Whole<2>>>>;
TYPED_TEST_SUITE(LanesOf, Kinds);

TYPED_TEST(LanesOf, DoToEachNumberWhatIsDoneToOne) {
  constexpr int kWidth = TypeParam::kWidth;
  using L = typename TypeParam::Numbers;
  static_assert(sizeof(L) == kWidth * sizeof(double) && sizeof(typename TypeParam::Marks) == sizeof(L));
  double from[kWidth + 1], to[kWidth + 1];
  for (int i = 0; i <= kWidth; ++i) from[i] = (i % 2 == 0 ? -1.5 : 2.0) * (i + 1), to[i] = 99;
  const L x = loadLanes<L>(from), seven = broadcast<L>(7);
  storeLanes(magnitude(x), to);
  EXPECT_EQ(to[kWidth], 99) << "and not beyond them";
  const L sum = mulAdd(x, seven, x), scaled = mulAdd(0.5, x, seven), root = squareRoot(magnitude(x));
  const L mixed = (2.0 * x - seven) / (x * x + 1.0) - (-x);
  const L chosen = choose(x > seven, x, seven);
  L added = x;
  added += seven, added -= 1.0, added *= 3.0;
  for (int i = 0; i < kWidth; ++i) {
    EXPECT_EQ(to[i], std::abs(from[i])) << i;
    EXPECT_EQ(sum[i], 8 * from[i]) << i;
    EXPECT_EQ(scaled[i], 0.5 * from[i] + 7) << i;
    EXPECT_EQ(root[i], std::sqrt(std::abs(from[i]))) << i;
    EXPECT_EQ(mixed[i], (2 * from[i] - 7) / (from[i] * from[i] + 1) + from[i]) << i;
    EXPECT_EQ(chosen[i], std::max(from[i], 7.0)) << i;
    EXPECT_EQ(added[i], (from[i] + 6) * 3) << i;
  }
  EXPECT_FALSE(std::signbit(broadcast<L>(0.0)[0]));
  EXPECT_TRUE(std::signbit(broadcast<L>(-0.0)[kWidth - 1]));
}

TYPED_TEST(LanesOf, MoveToTheirNeighbours) {
  constexpr int kWidth = TypeParam::kWidth;
  using L = typename TypeParam::Numbers;
  double numbers[3 * kWidth];
  for (int i = 0; i < 3 * kWidth; ++i) numbers[i] = i + 1;
  const L before = loadLanes<L>(numbers), x = loadLanes<L>(numbers + kWidth), after = loadLanes<L>(numbers + 2 * kWidth);
  for (int i = 0; i < kWidth; ++i) {
    EXPECT_EQ(next(x, after)[i], numbers[kWidth + i + 1]) << i;
    EXPECT_EQ(previous(before, x)[i], numbers[kWidth + i - 1]) << i;
    EXPECT_EQ(upperHalf(x)[i], i < kWidth / 2 ? numbers[kWidth + kWidth / 2 + i] : 0) << i;
  }
}

TYPED_TEST(LanesOf, AreAskedForAnyMarkWhereverItStands) {
  using Marks = typename TypeParam::Marks;
  EXPECT_FALSE(anyLane(Marks{}));
  for (int i = 0; i < TypeParam::kWidth; ++i) {
    Marks marks{};
    marks[i] = -1;
    EXPECT_TRUE(anyLane(marks)) << i;
    EXPECT_TRUE(anyLane(marks | Marks{})) << i;
  }
}

TYPED_TEST(LanesOf, AreAllZeroOnlyWithoutAnythingInfinite) {
  using L = typename TypeParam::Numbers;
  EXPECT_TRUE(allZero(broadcast<L>(3) * 0.0));
  EXPECT_TRUE(allZero(broadcast<L>(-3) * 0.0));
  for (int i = 0; i < TypeParam::kWidth; ++i)
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
