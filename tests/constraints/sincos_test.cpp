#include "constraints/formula/sincos.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "base/math/elementary.h"

namespace reachlab::constraints {
namespace {

TEST(SinCos, StaysWithinItsErrorOfLongDouble) {
  constexpr double kError = 1.7e-16;  // as the header promises
  std::mt19937_64 random(3);
  double worst = 0;
  for (const double range : {1.0, 10.0, 1e3, 1e5}) {
    std::uniform_real_distribution<double> uniform(-range, range);
    for (int i = 0; i < 20000; ++i) {
      const double x = uniform(random);
      double s, c;
      sinCos(x, s, c);
      worst = std::max({worst, std::abs(static_cast<double>(s - std::sin(static_cast<long double>(x)))),
                        std::abs(static_cast<double>(c - std::cos(static_cast<long double>(x))))});
    }
  }
  EXPECT_LE(worst, kError);
}

TEST(SinCos, GoesOnWithTheElementaryFunctionsBeyondItsRange) {
  for (const double x : {1.1e5, -3e8, 1e300}) {
    double s, c;
    sinCos(x, s, c);
    EXPECT_EQ(s, elementary::sin(x));
    EXPECT_EQ(c, elementary::cos(x));
  }
  double s, c;
  sinCos(std::numeric_limits<double>::quiet_NaN(), s, c);
  EXPECT_TRUE(std::isnan(s) && std::isnan(c));
  sinCos(std::numeric_limits<double>::infinity(), s, c);
  EXPECT_TRUE(std::isnan(s) && std::isnan(c));
}

TEST(SinCos, IsExactAtZeroAndOddAndEven) {
  double s, c, s2, c2;
  sinCos(0, s, c);
  EXPECT_EQ(s, 0);
  EXPECT_EQ(c, 1);
  sinCos(1.234, s, c);
  sinCos(-1.234, s2, c2);
  EXPECT_EQ(s, -s2);
  EXPECT_EQ(c, c2);
}

}  // namespace
}  // namespace reachlab::constraints
