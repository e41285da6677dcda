// The arithmetic below the predictions, each part by what it promises.
#include <gtest/gtest.h>

#include <cmath>
#include <memory_resource>
#include <random>

#include "base/error.h"
#include "sim/predict/numerics/double_double.h"
#include "sim/predict/numerics/lane_matrix.h"
#include "sim/predict/numerics/work_limit.h"
#include "tests/refusal.h"

namespace reachlab::predict {
namespace {

// As exact as needed: a sum of four doubles whose products are formed without rounding.
__extension__ using Wide = __float128;

constexpr double kDigits = 1e-30;  // relative: 106 bits, and a few roundings of the last of them

Wide wide(const DoubleDouble& x) { return static_cast<Wide>(x.hi) + static_cast<Wide>(x.lo); }
double relative(const DoubleDouble& x, Wide truth) { return std::abs(static_cast<double>((wide(x) - truth) / truth)); }

TEST(DoubleDouble, ItsFourOperationsAreRightToThirtyDigits) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-10, 10);
  for (int i = 0; i < 200; ++i) {
    const DoubleDouble a = DoubleDouble::ofSum(number(random), 1e-17 * number(random)),
                       b = DoubleDouble::ofSum(number(random), 1e-17 * number(random));
    EXPECT_LT(relative(a * b, wide(a) * wide(b)), kDigits);
    EXPECT_LT(relative(a / b, wide(a) / wide(b)), kDigits);
    EXPECT_LT(std::abs(static_cast<double>(wide(a + b) - (wide(a) + wide(b)))), kDigits * 20);
    EXPECT_LT(std::abs(static_cast<double>(wide(a - b) - (wide(a) - wide(b)))), kDigits * 20);
    EXPECT_EQ(static_cast<double>(wide(-a) + wide(a)), 0);
    DoubleDouble sum = a, difference = a, product = a, quotient = a;
    sum += b, difference -= b, product *= b, quotient /= b;
    EXPECT_EQ(wide(sum), wide(a + b));
    EXPECT_EQ(wide(difference), wide(a - b));
    EXPECT_EQ(wide(product), wide(a * b));
    EXPECT_EQ(wide(quotient), wide(a / b));
    const DoubleDouble size = a.hi < 0 ? -a : a, root = sqrt(size);
    EXPECT_LT(relative(root * root, wide(size)), 10 * kDigits);
    EXPECT_GE(root.hi, 0);
    for (const DoubleDouble& x : {a + b, a * b, a / b}) EXPECT_EQ(x.hi, x.hi + x.lo) << "the parts do not overlap";
  }
}

TEST(DoubleDouble, ASumOfTwoDoublesLosesNothing) {
  for (const auto& [a, b] : {std::pair{1.0, 1e-20}, {1e-20, 1.0}, {0.1, 0.7}, {-3.0, 1e16}}) {
    EXPECT_EQ(wide(DoubleDouble::ofSum(a, b)), static_cast<Wide>(a) + b);
    EXPECT_EQ(DoubleDouble::ofSum(a, b).hi, a + b);
    const double more = std::abs(a) > std::abs(b) ? a : b, less = a + b - more == 0 || more == a ? b : a;
    EXPECT_EQ(wide(DoubleDouble::ofOrderedSum(more, less)), static_cast<Wide>(more) + less);
  }
}

TEST(DoubleDouble, IsComparedByAllItsDigits) {
  const DoubleDouble one(1.0), more(1.0, 1e-20), less(1.0, -1e-20), two(2.0, -1e-20);
  EXPECT_TRUE(less < one && one < more && more < two && less < two);
  EXPECT_TRUE(more > one && two > more);
  EXPECT_FALSE(one < one || one > one || more < one || two < one || one > two);
  EXPECT_EQ(static_cast<double>(DoubleDouble(3.0, 0.5)), 3.5);
  EXPECT_EQ(sqrt(DoubleDouble(0.0)).hi, 0);
  EXPECT_EQ(sqrt(DoubleDouble(-1.0)).hi, 0) << "rounding below zero is zero";
  EXPECT_EQ(DoubleDouble().hi, 0);
  EXPECT_EQ(DoubleDouble().lo, 0);
}

// Every size up to beyond two batches of eight, so that each way of sharing rows and batches is taken.
template <class Real>
class LaneMatrices : public testing::Test {
 protected:
  using Matrix = LaneMatrix<Real>;
  Matrix make(int rows, int columns) {
    Matrix made(&memory, rows, columns);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) made.set(i, j, Real(number(random)));
    return made;
  }
  double at(const Matrix& m, int i, int j) const { return static_cast<double>(m.at(i, j)); }
  std::pmr::unsynchronized_pool_resource memory;
  std::mt19937 random{5};
  std::uniform_real_distribution<double> number{-1, 1};
};
using Reals = testing::Types<double, DoubleDouble>;
TYPED_TEST_SUITE(LaneMatrices, Reals);

TYPED_TEST(LaneMatrices, AProductIsTheSumOverRowAndColumn) {
  for (const auto& [n, k, m] : {std::array{1, 1, 1}, {3, 5, 7}, {4, 8, 8}, {5, 2, 9}, {9, 17, 23}, {8, 3, 16}, {6, 9, 25}}) {
    const auto a = this->make(n, k), b = this->make(k, m);
    const auto product = a * b;
    ASSERT_EQ(product.rows(), n);
    ASSERT_EQ(product.columns(), m);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < m; ++j) {
        double sum = 0;
        for (int l = 0; l < k; ++l) sum += this->at(a, i, l) * this->at(b, l, j);
        ASSERT_NEAR(this->at(product, i, j), sum, 1e-14) << n << ' ' << k << ' ' << m << ": " << i << ' ' << j;
      }
    std::vector<typename LaneMatrix<TypeParam>::Batch> row(static_cast<std::size_t>(product.batches()));
    const auto start = this->make(1, m);
    for (const bool fromStart : {false, true}) {
      multiplyRow<TypeParam>(a.row(n - 1), b, fromStart ? start.row(0) : nullptr, row.data());
      for (int j = 0; j < m; ++j)
        ASSERT_NEAR(static_cast<double>(laneOf(row[j / 8], j % 8)), this->at(product, n - 1, j) + (fromStart ? this->at(start, 0, j) : 0),
                    1e-14);
    }
  }
}

TYPED_TEST(LaneMatrices, RowsOfZerosAreZeros) {
  auto a = this->make(5, 6);
  for (int j = 0; j < 6; ++j) a.set(2, j, TypeParam(0.0));
  for (int i = 0; i < 4; ++i) a.set(i, 3, TypeParam(0.0));  // a column of zeros for four rows at once
  const auto b = this->make(6, 11), product = a * b;
  for (int j = 0; j < 11; ++j) {
    EXPECT_EQ(this->at(product, 2, j), 0);
    double sum = 0;
    for (int l = 0; l < 6; ++l) sum += this->at(a, 4, l) * this->at(b, l, j);
    EXPECT_NEAR(this->at(product, 4, j), sum, 1e-14) << "the last row has a number there";
  }
}

TYPED_TEST(LaneMatrices, TransposesCopiesAndSums) {
  const auto a = this->make(4, 11);
  const auto turned = transpose(a);
  auto twice = a.copy();
  twice += a;
  EXPECT_EQ(turned.rows(), 11);
  EXPECT_EQ(turned.columns(), 4);
  EXPECT_EQ(a.batches(), 2);
  EXPECT_EQ(turned.batches(), 1);
  const auto identity = LaneMatrix<TypeParam>::identity(&this->memory, 11);
  const auto same = a * identity;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 11; ++j) {
      EXPECT_EQ(this->at(turned, j, i), this->at(a, i, j));
      EXPECT_EQ(this->at(twice, i, j), 2 * this->at(a, i, j));
      EXPECT_EQ(this->at(same, i, j), this->at(a, i, j));
    }
  Eigen::MatrixXd dense(3, 9);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 9; ++j) dense(i, j) = 10 * i + j;
  const LaneMatrix<TypeParam> taken(&this->memory, dense);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 9; ++j) EXPECT_EQ(this->at(taken, i, j), dense(i, j));
}

TYPED_TEST(LaneMatrices, ATriangleTimesItsTransposeIsTheMatrix) {
  for (const int n : {1, 4, 9, 18}) {
    const auto root = this->make(n, n + 2);
    auto a = root * transpose(root);
    const auto l = factoriseCholesky(a);
    const auto entry = [&](int i, int j) { return static_cast<double>(l[i * n + j]); };
    for (int i = 0; i < n; ++i) {
      EXPECT_GT(entry(i, i), 0);
      for (int j = 0; j < n; ++j) {
        if (j > i) {
          EXPECT_EQ(entry(i, j), 0) << "a lower triangle";
        }
        double sum = 0;
        for (int k = 0; k < n; ++k) sum += entry(i, k) * entry(j, k);
        ASSERT_NEAR(sum, this->at(a, i, j), 1e-13) << n;
      }
    }
    a.set(n - 1, n - 1, TypeParam(-1.0));
    EXPECT_TRUE(std::isnan(static_cast<double>(factoriseCholesky(a).back())));
  }
  auto none = this->make(1, 1);
  none.set(0, 0, TypeParam(0.0));
  EXPECT_TRUE(std::isnan(static_cast<double>(factoriseCholesky(none)[0]))) << "zero is not positive";
}

// 1/3 is no double: what a product keeps of it beyond the sixteenth digit is the point of the wide lanes.
TEST(WideLanes, AProductOfMatricesKeepsThirtyDigits) {
  std::pmr::unsynchronized_pool_resource memory;
  const DoubleDouble third = DoubleDouble(1.0) / 3.0;
  for (const int k : {1, 2, 7, 10}) {
    LaneMatrix<DoubleDouble> a(&memory, 5, k), b(&memory, k, 19);
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < k; ++j) a.set(i, j, third * DoubleDouble(1.0 + i));
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < 19; ++j) b.set(i, j, third * DoubleDouble(j % 2 == 0 ? 1.0 + i : -1.0 - i));
    const auto product = a * b;
    std::vector<WideBatch> row(static_cast<std::size_t>(b.batches()));
    multiplyRow<DoubleDouble>(a.row(4), b, b.row(0), row.data());
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 19; ++j) {
        const Wide truth = static_cast<Wide>((1.0 + i) * (k * (k + 1) / 2) * (j % 2 == 0 ? 1 : -1)) / 9;
        ASSERT_LT(relative(product.at(i, j), truth), 20 * kDigits);
        const DoubleDouble sum = laneOf(row[j / 8], j % 8);
        if (i == 4) {
          ASSERT_LT(relative(sum, truth + wide(b.at(0, j))), 20 * kDigits);
        }
      }
    auto more = product.copy();
    more += product;
    EXPECT_LT(relative(more.at(4, 18), 2 * wide(product.at(4, 18))), kDigits);
    EXPECT_EQ(leading(third), third.hi);
  }
}

TEST(WideLanes, ACholeskyRootKeepsThirtyDigits) {
  std::pmr::unsynchronized_pool_resource memory;
  LaneMatrix<DoubleDouble> a(&memory, 2, 2);
  const DoubleDouble third = DoubleDouble(1.0) / 3.0;
  a.set(0, 0, third), a.set(1, 0, third * third), a.set(0, 1, third * third), a.set(1, 1, third);
  const auto l = factoriseCholesky(a);
  EXPECT_LT(relative(l[0] * l[0], wide(third)), 10 * kDigits);
  EXPECT_LT(relative(l[2] * l[0], wide(third) * wide(third)), 10 * kDigits);
  EXPECT_LT(relative(l[2] * l[2] + l[3] * l[3], wide(third)), 10 * kDigits);
}

TEST(WorkLimit, RefusesOnceAllThatWasSpentIsTooMuch) {
  WorkLimit limit;
  EXPECT_NO_THROW(limit.spend(1e10));
  EXPECT_NO_THROW(limit.spend(4.9e9));
  EXPECT_THROW(limit.spend(0.2e9), RefusedError);
  EXPECT_NO_THROW(WorkLimit().spend(1.5e10));
  EXPECT_NO_THROW(WorkLimit::hold(3e7));
  EXPECT_THROW(WorkLimit::hold(3.01e7), RefusedError);
  const std::string said = refusalOf<RefusedError>([] { WorkLimit::hold(5e7); });
  EXPECT_TRUE(holds(said, "5.0e+07 numbers at once; allowed: up to 3e+07"));
}

}  // namespace
}  // namespace reachlab::predict
