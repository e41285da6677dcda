#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/math/butterworth.h"
#include "base/math/cubic_spline.h"
#include "base/math/minimum_jerk.h"
#include "base/ticks.h"

/// Laws that stand once and are used in many places.
namespace reachlab {
namespace {

TEST(Ticks, InSecondsAreTheDoubleThatIsWritten) {
  static_assert(kTickSeconds * kTicksPerSecond == 1 && kTickNs == 1'000'000);
  EXPECT_EQ(secondsOf(std::uint64_t{1350}), 1.35);
  EXPECT_EQ(secondsBetween(2000, 650), -1.35);
  for (std::uint64_t tick = 0; tick < 100'000; tick += 7)
    EXPECT_EQ(secondsOf(tick), std::stod(std::to_string(tick) + "e-3")) << "rounded once, as a reader of the text rounds";
}

// The law is the fifth-degree polynomial that is at rest, with no acceleration, at both ends, and halfway in the middle.
TEST(MinimumJerk, IsAtRestAtBothEndsAndItsRatesAreItsDerivatives) {
  for (const double end : {0.0, 1.0}) {
    EXPECT_EQ(minimumJerk(end), end);
    EXPECT_EQ(minimumJerkRate(end), 0);
    EXPECT_EQ(minimumJerkAcceleration(end), 0);
  }
  EXPECT_EQ(minimumJerk(0.5), 0.5);
  EXPECT_EQ(minimumJerkRate(0.5), 1.875) << "the peak, 15/8";
  for (double x = 0.05; x < 1; x += 0.05) {
    constexpr double kStep = 1e-30;  // complex step: no difference of near numbers, so the error is rounding
    const std::complex<double> there(x, kStep);
    const auto power = [&](int n) { return std::pow(there, n); };
    EXPECT_NEAR(minimumJerkRate(x), (10.0 * power(3) - 15.0 * power(4) + 6.0 * power(5)).imag() / kStep, 1e-13);
    EXPECT_NEAR(minimumJerkAcceleration(x), (30.0 * power(2) - 60.0 * power(3) + 30.0 * power(4)).imag() / kStep, 1e-12);
  }
}

TEST(MinimumJerk, IsHeldBeyondItsEndsAndKeepsItsDigitsNearThem) {
  EXPECT_EQ(heldMinimumJerk(-0.1).value, 0);
  EXPECT_EQ(heldMinimumJerk(1.1).value, 1);
  EXPECT_EQ(heldMinimumJerk(1.1).rate, 0);
  using FiftyDigits = boost::multiprecision::cpp_bin_float_50;
  for (double x = 0.01; x < 1; x += 0.01)
    EXPECT_NEAR(heldMinimumJerk(x).value, static_cast<double>(minimumJerk(FiftyDigits(x))), 2.5e-16) << "a rounding of 1";
}

// |H(f)|^2 = 1/(1 + (W(f)/W(fc))^4) with W(f) = tan(pi f dt), the axis that the bilinear transform warps.
TEST(Butterworth, HasItsMagnitudeOnTheWarpedAxis) {
  const double cutoff = 40, dt = 0.001;
  const Biquad filter = butterworthLowPass(cutoff, dt);
  for (const double f : {0.0, 5.0, 40.0, 100.0, 499.0}) {
    const auto z = std::polar(1.0, -2 * std::numbers::pi * f * dt);
    const auto h = (filter.b[0] + filter.b[1] * z + filter.b[2] * z * z) / (filter.a[0] + filter.a[1] * z + filter.a[2] * z * z);
    const double ratio = std::tan(std::numbers::pi * f * dt) / std::tan(std::numbers::pi * cutoff * dt);
    EXPECT_NEAR(std::norm(h), 1 / (1 + std::pow(ratio, 4)), 1e-12) << f << " Hz";
  }
}

CubicSpline sineSpline(int parts, SplineEnds ends) {
  std::vector<double> time;
  std::vector<Vec3> value;
  for (int i = 0; i <= parts; ++i) {
    time.push_back(std::numbers::pi * i / parts);
    value.push_back({std::sin(time.back()), 0, 0});
  }
  return {time, value, ends};
}

// sin has no curvature at 0 and pi, so that the natural spline's error falls with the fourth power of the spacing like any cubic's.
TEST(CubicSpline, ErrorFallsWithTheFourthPowerOfTheSpacing) {
  for (const SplineEnds ends : {SplineEnds::Natural, SplineEnds::NotAKnot}) {
    const auto errorWith = [&](int parts) {
      const CubicSpline spline = sineSpline(parts, ends);
      double worst = 0;
      for (int i = 0; i <= 1000; ++i) {
        const double t = std::numbers::pi * i / 1000;
        worst = std::max(worst, std::abs(spline.at(t).value.x - std::sin(t)));
      }
      return worst;
    };
    EXPECT_NEAR(errorWith(40) / errorWith(80), 16, 2.5) << "the next order adds some per cent";
  }
}

TEST(CubicSpline, NaturalGoesThroughItsPointsAndIsStraightThroughTwo) {
  const std::vector<double> time{0, 0.1, 0.5, 0.55, 2};
  const std::vector<Vec3> value{{0, 1, 0}, {2, 0, 1}, {1, 1, 1}, {0, 5, 0}, {3, 3, 3}};
  const CubicSpline spline(time, value, SplineEnds::Natural);
  for (std::size_t i = 0; i < time.size(); ++i) EXPECT_NEAR(norm(spline.at(time[i]).value - value[i]), 0, 1e-12);
  EXPECT_NEAR(CubicSpline({0, 2}, {{0, 0, 0}, {4, 0, 0}}, SplineEnds::Natural).at(0.5).value.x, 1, 1e-15);
}

// Not-a-knot keeps every cubic, its rate too; natural ends do not.
TEST(CubicSpline, NotAKnotKeepsACubicAndItsRate) {
  const auto cubic = [](double t) { return Vec3{1 + t - 2 * t * t + 3 * t * t * t, t, -t * t}; };
  const auto rate = [](double t) { return Vec3{1 - 4 * t + 9 * t * t, 1, -2 * t}; };
  for (const std::vector<double>& time : {std::vector<double>{0, 0.1, 0.5, 0.55, 2}, {-1, 0, 1, 3}}) {
    std::vector<Vec3> value;
    for (const double t : time) value.push_back(cubic(t));
    const CubicSpline spline(time, value, SplineEnds::NotAKnot), natural(time, value, SplineEnds::Natural);
    for (double t = time.front(); t <= time.back(); t += 0.01) {
      EXPECT_NEAR(norm(spline.at(t).value - cubic(t)), 0, 1e-13 * 100);
      EXPECT_NEAR(norm(spline.at(t).rate - rate(t)), 0, 1e-12 * 100);
    }
    EXPECT_GT(norm(natural.at(0.05).value - cubic(0.05)), 1e-3);
  }
  const CubicSpline parabola({0, 1, 3}, {{0, 0, 0}, {1, 0, 0}, {9, 0, 0}}, SplineEnds::NotAKnot);
  EXPECT_NEAR(parabola.at(2).value.x, 4, 1e-14);
}

TEST(CubicSpline, IsHeldBeyondItsEnds) {
  for (const SplineEnds ends : {SplineEnds::Natural, SplineEnds::NotAKnot}) {
    const CubicSpline spline = sineSpline(8, ends);
    EXPECT_EQ(spline.at(-1).value.x, 0);
    EXPECT_EQ(spline.at(-1).rate, Vec3{});
    EXPECT_NEAR(spline.at(0).rate.x, 1, 0.02) << "the inner rate at the end itself";
    EXPECT_NEAR(spline.at(std::numbers::pi).rate.x, -1, 0.02);
    EXPECT_EQ(spline.at(4).rate, Vec3{});
    EXPECT_EQ(CubicSpline({0.5}, {{1, 2, 3}}, ends).at(7).value, (Vec3{1, 2, 3}));
  }
}

}  // namespace
}  // namespace reachlab
