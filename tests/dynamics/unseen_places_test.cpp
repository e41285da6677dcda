#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/dynamics/make_experiment.h"

/// Places that a step of a millisecond could lead over or through. The laws are those of free masses: a speed along the line that never
/// changes, and straight lines on a surface that is unfolded.
namespace reachlab::dynamics {
namespace {

constexpr double kShort = 2e-5;  // [s] of a step, so that 1000 right-hand sides are enough in it

using Slope = std::function<long double(long double)>;

/// The length of a line with |r_phi|^2 = 0.01 + y'^2 from `from` to `to`, by Simpson's rule on parts that become short about `spot`.
long double lengthOf(const Slope& slope, long double from, long double to, long double spot, long double width) {
  std::vector<long double> bounds{from, to};
  for (long double d = width / 8; d < 2; d *= 1.25L)
    for (const long double at : {spot - d, spot + d})
      if (at > from && at < to) bounds.push_back(at);
  if (spot > from && spot < to) bounds.push_back(spot);
  std::sort(bounds.begin(), bounds.end());
  const auto speed = [&](long double phi) { return std::sqrt(0.01L + slope(phi) * slope(phi)); };
  long double sum = 0;
  constexpr int kParts = 200;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    const long double h = (bounds[i + 1] - bounds[i]) / kParts;
    for (int k = 0; k < kParts; ++k) {
      const long double a = bounds[i] + h * k;
      sum += h / 6 * (speed(a) + 4 * speed(a + h / 2) + speed(a + h));
    }
  }
  return sum;
}

struct Spot {
  std::string y;
  Slope slope;
  double at, width;
};
std::vector<Spot> spots() {
  std::vector<Spot> all;
  for (const double w : {1e-3, 1e-5}) {
    const double n = 1 / (w * w), m = std::cos(0.5);
    all.push_back({fmt::format("{}/(1 + {}*(cos({{0}}) - {})^2)", w, n, m),
                   [=](long double p) {
                     const long double c = std::cos(p) - m, s = 1 + n * c * c;
                     return 2 * w * n * c * std::sin(p) / (s * s);
                   },
                   0.5, w});
    all.push_back({fmt::format("{}*exp(-(({{0}} - 0.3)/{})^2)", w, w),
                   [=](long double p) {
                     const long double x = (p - 0.3L) / w;
                     return -2 * x * std::exp(-x * x);
                   },
                   0.3, w});
    all.push_back({fmt::format("0.1*sqrt(({{0}} - 0.3)^2 + {})", w * w),
                   [=](long double p) { return 0.1L * (p - 0.3L) / std::sqrt((p - 0.3L) * (p - 0.3L) + static_cast<long double>(w * w)); },
                   0.3, w});
  }
  return all;
}
std::string inTermsOf(const std::string& y, const char* parameter) { return fmt::format(fmt::runtime(y), parameter); }

TEST(UnseenPlaces, AMassOnACurveKeepsItsSpeedThroughNeedlesAndRoundedCorners) {
  for (const Spot& spot : spots())
    for (const double start : {-0.3, -0.30037}) {
      SCOPED_TRACE(fmt::format("{} from {}", spot.y, start));
      Scene scene = freeScene(onCurve(makePoint(), "0.1*phi", inTermsOf(spot.y, "phi"), "0"), {start}, {1.3});
      const double speed = norm(observed(*scene.plant)[0].v);
      ASSERT_EQ(run(*scene.plant, noHand, 1.2, kShort), StepStatus::Ok) << scene.plant->stopReason();
      const long double way = lengthOf(spot.slope, start, observed(*scene.plant)[0].q[0], spot.at, spot.width);
      EXPECT_NEAR(static_cast<double>(way), 1.2 * speed, 1e-9);
    }
}

// A cylinder over the same lines, met aslant. The parameters are in all scales.
TEST(UnseenPlaces, AMassOnASurfaceKeepsItsSpeedAcrossRidges) {
  for (const Spot& spot : spots())
    for (const double unit : {1.0, 1e-3, 1e3}) {
      SCOPED_TRACE(fmt::format("{} in units of {}", spot.y, unit));
      const std::string u = fmt::format("({}*u)", unit);
      Scene scene = freeScene(onSurface("0.1*" + u, inTermsOf(spot.y, u.c_str()), "0.1*v"), {-0.3 / unit, 0}, {1.3 / unit, 0.4});
      const MassState begin = observed(*scene.plant)[0];
      const double across = std::sqrt(dot(begin.v, begin.v) - begin.v.z * begin.v.z);
      const StepStatus status = run(*scene.plant, noHand, 1.2, kShort);
      if (spot.width < 1e-4 && status == StepStatus::Capped) continue;  // refused: the step has too few right-hand sides
      ASSERT_EQ(status, StepStatus::Ok) << scene.plant->stopReason();
      const MassState end = observed(*scene.plant)[0];
      EXPECT_NEAR(end.r.z, 1.2 * 0.04, 1e-9);
      EXPECT_NEAR(static_cast<double>(lengthOf(spot.slope, -0.3, unit * end.q[0], spot.at, spot.width)), 1.2 * across, 1e-9);
    }
}

// Ripples of a hundredth of a millimetre: y' = cos(1e5 phi) has a whole number of equal waves.
TEST(UnseenPlaces, AMassOnRipplesKeepsItsSpeed) {
  const Slope slope = [](long double p) { return std::cos(1e5L * p); };
  for (const double rate : {0.1296, 0.02}) {
    Scene scene = freeScene(onCurve(makePoint(), "0.1*phi", "1e-5*sin(1e5*phi)", "0"), {7e-6}, {rate});
    const double speed = norm(observed(*scene.plant)[0].v);
    ASSERT_EQ(run(*scene.plant, noHand, 0.04, kShort), StepStatus::Ok) << scene.plant->stopReason();
    const double end = observed(*scene.plant)[0].q[0];
    long double way = 0;
    for (long double a = 7e-6L; a < end;) {
      const long double b = std::min<long double>(a + 1e-5L, end);
      way += lengthOf(slope, a, b, a - 9, 1);  // outside: even parts
      a = b;
    }
    EXPECT_NEAR(static_cast<double>(way), 0.04 * speed, 1e-9);
  }
}

/// A cone 0.1 v (cos u, sin u, slope) unfolded: where a mass from (u, v) = (0, 1) with rates (turn, -1) is after `time`.
Vec3 onUnfoldedCone(double slope, double turn, double time) {
  const long double slant = std::sqrt(1 + static_cast<long double>(slope) * slope), radius = slant / 10,
                    across = radius * turn / slant * time, along = radius - radius * time,
                    far = std::sqrt(along * along + across * across) / radius, u = std::atan2(across, along) * slant;
  return {static_cast<double>(far * std::cos(u) / 10), static_cast<double>(far * std::sin(u) / 10), static_cast<double>(far * slope / 10)};
}

TEST(UnseenPlaces, AMassPassesBesideTheApexOfAConeOrStopsThere) {
  for (const double slope : {0.3, 1.0, 3.0, 10.0})
    for (const double turn : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
      SCOPED_TRACE(fmt::format("slope {}, turn {}", slope, turn));
      Scene scene = freeScene(onSurface("0.1*v*cos(u)", "0.1*v*sin(u)", fmt::format("{}*v", 0.1 * slope)), {0, 1}, {turn, -1});
      const StepStatus status = run(*scene.plant, noHand, 1.6, kShort);
      const double off = norm(observed(*scene.plant)[0].r - onUnfoldedCone(10 * (0.1 * slope), turn, 1.6));
      EXPECT_TRUE(status == StepStatus::NoContinuation || (status == StepStatus::Ok && off < 1e-9)) << off << scene.plant->stopReason();
      EXPECT_TRUE(turn < 1e-2 || status == StepStatus::Ok) << scene.plant->stopReason();
      EXPECT_TRUE(turn > 1e-6 || status == StepStatus::NoContinuation);
    }
}

TEST(UnseenPlaces, AMassThatMeetsTheApexOfAConeStops) {
  for (const double slope : {0.3, 1.0, 10.0})
    for (const double start : {0.0, 0.41034, 0.91328}) {
      Scene scene = freeScene(onSurface("0.1*v*cos(u)", "0.1*v*sin(u)", fmt::format("{}*v", 0.1 * slope)), {start, 1}, {0, -1});
      ASSERT_EQ(run(*scene.plant, noHand, 1.6, kShort), StepStatus::NoContinuation) << slope << " " << start;
      EXPECT_LT(norm(observed(*scene.plant)[0].r), 3e-3 * (1 + slope));
      EXPECT_TRUE(holds(scene.plant->stopReason(), "apex"));
    }
}

}  // namespace
}  // namespace reachlab::dynamics
