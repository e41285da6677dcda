#include "sim/dynamics/exact/propagator.h"

#include <gtest/gtest.h>

#include <functional>

namespace reachlab::dynamics {
namespace {

/// What drives a chain besides its springs, at s = t/dt: force on mass 1 [N] and acceleration of all [m/s^2].
struct Drive {
  std::function<double(double)> force = [](double) { return 0.0; };
  double gravity = 0;
};

/// (x_1, x_2 - x_1, ..., v_1, v_2 - v_1, ...) after dt, by many short steps of RK4 on the masses themselves.
std::vector<double> followed(const ObjectModel& m, bool coupled, double dt, const std::vector<double>& z, const Drive& drive, int steps) {
  const int n = m.count();
  std::vector<double> y(z);
  for (const int block : {0, n})
    for (int i = 1; i < n; ++i) y[block + i] += y[block + i - 1];
  const auto rate = [&](double s, const std::vector<double>& at) {
    std::vector<double> d(2 * n);
    for (int i = 0; i < n; ++i) {
      double f = -m.viscosity * at[n + i] + (i == 0 ? drive.force(s) : 0);
      if (coupled) f -= m.handStiffness[i] * at[i] + m.handDamping[i] * at[n + i];
      if (i > 0) f -= m.stiffness[i - 1] * (at[i] - at[i - 1]) + m.damping[i - 1] * (at[n + i] - at[n + i - 1]);
      if (i + 1 < n) f += m.stiffness[i] * (at[i + 1] - at[i]) + m.damping[i] * (at[n + i + 1] - at[n + i]);
      d[i] = at[n + i];
      d[n + i] = f / m.mass[i] + drive.gravity;
    }
    return d;
  };
  const double h = dt / steps;
  const auto plus = [&](const std::vector<double>& a, double by, const std::vector<double>& b) {
    std::vector<double> sum(a);
    for (std::size_t i = 0; i < a.size(); ++i) sum[i] += by * b[i];
    return sum;
  };
  for (int k = 0; k < steps; ++k) {
    const double s = k / static_cast<double>(steps), half = s + 0.5 / steps, end = s + 1.0 / steps;
    const auto k1 = rate(s, y), k2 = rate(half, plus(y, h / 2, k1)), k3 = rate(half, plus(y, h / 2, k2)), k4 = rate(end, plus(y, h, k3));
    for (int i = 0; i < 2 * n; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  for (const int block : {0, n})
    for (int i = n - 1; i > 0; --i) y[block + i] -= y[block + i - 1];
  return y;
}

ObjectModel chainModel(int n, double stiffness) {
  ObjectModel m;
  m.kind = experiment::ObjectKind::Chain;
  m.viscosity = 0.4;
  for (int i = 0; i < n; ++i) {
    m.mass.push_back(0.5 + 0.3 * (i % 3));
    m.handStiffness.push_back(i == 0 ? 90 : 0);
    m.handDamping.push_back(i == 0 ? 2 : 0);
    if (i + 1 < n) m.stiffness.push_back(stiffness * (1 + 0.2 * (i % 4))), m.damping.push_back(1 + 0.5 * (i % 2));
  }
  return m;
}

void expectFollowed(const ObjectModel& m, bool coupled, double dt, int steps, double within) {
  const Propagator p = computePropagator(m, coupled, dt);
  const int n = m.count(), all = 2 * n;
  ASSERT_EQ(p.n, n);
  ASSERT_EQ(p.dt, dt);
  ASSERT_EQ(p.d.size(), static_cast<std::size_t>(all * all));
  ASSERT_EQ(p.gravity.size(), static_cast<std::size_t>(all));
  const std::vector<double> rest(static_cast<std::size_t>(all), 0.0);
  for (int j = 0; j<all; j += n> 5 ? 7 : 1) {
    std::vector<double> unit = rest;
    unit[j] = 1;
    const std::vector<double> after = followed(m, coupled, dt, unit, {}, steps);
    for (int i = 0; i < all; ++i) EXPECT_NEAR(p.d[j * all + i], after[i] - unit[i], within * (i < n ? 1 : 20)) << i << " by " << j;
  }
  for (int k = 0; k<kForceTerms; k += n> 5 ? 3 : 1) {
    const auto after = followed(m, coupled, dt, rest, {[k](double s) { return std::pow(s, k); }, 0}, steps);
    ASSERT_EQ(p.force[k].size(), static_cast<std::size_t>(all));
    for (int i = 0; i < all; ++i) EXPECT_NEAR(p.force[k][i], after[i], within) << i << " by s^" << k;
  }
  Drive falling;
  falling.gravity = 1;
  const auto after = followed(m, coupled, dt, rest, falling, steps);
  for (int i = 0; i < all; ++i) EXPECT_NEAR(p.gravity[i], after[i], within) << i << " by gravity";
}

// Steps of an eighth of a radian of the fastest mode and less; RK4 in 400 parts of them errs by 1e-13 of it.
TEST(Propagator, IsWhatManyShortStepsComeTo) {
  for (const int n : {1, 2, 3, 5})
    for (const bool coupled : {true, false}) {
      SCOPED_TRACE(n);
      expectFollowed(chainModel(n, 200), coupled, 5e-3, 400, 1e-12);
    }
}

// Over a whole turn of the fastest mode: by halved steps that are doubled back.
TEST(Propagator, OfALongStepIsThatOfManyAsWell) {
  for (const bool coupled : {true, false}) expectFollowed(chainModel(3, 200), coupled, 0.2, 4000, 1e-10);
}

// Above 24 masses in 64 bits.
TEST(Propagator, OfManyMassesIsTheSame) {
  for (const int n : {24, 25}) {
    SCOPED_TRACE(n);
    expectFollowed(chainModel(n, 200), true, 0.02, 400, 1e-11);
  }
}

// An undamped mode: x(dt) - 1 = cos(w dt) - 1, to the last bits however slow or fast the mode.
TEST(Propagator, OfOneMassIsTheSineAndCosineToTheLastBits) {
  for (const double w : {1e-4, 3.0, 5e5}) {
    ObjectModel m;
    m.mass = {4};
    m.handStiffness = {4 * w * w};
    m.handDamping = {0};
    const double dt = 1e-3, turn = w * dt;
    const Propagator p = computePropagator(m, true, dt);
    const double less = -2 * std::sin(turn / 2) * std::sin(turn / 2), sine = std::sin(turn);
    const double rounding = 4e-16 * std::max(1.0, turn);  // of w and of the argument
    EXPECT_NEAR(p.d[0], less, rounding * std::max(std::abs(less), turn * turn * 1e-3)) << w;
    EXPECT_NEAR(p.d[3], less, rounding * std::max(std::abs(less), turn * turn * 1e-3)) << w;
    EXPECT_NEAR(p.d[1], -w * sine, rounding * w * std::max(std::abs(sine), turn * 1e-3)) << w;
    EXPECT_NEAR(p.d[2], sine / w, rounding / w * std::max(std::abs(sine), turn * 1e-3)) << w;
    EXPECT_NEAR(p.force[0][0], -less / (4 * w * w), rounding * std::abs(less) / (4 * w * w) + rounding * dt * dt / 8) << w;
    EXPECT_NEAR(p.force[0][1], sine / (4 * w), rounding * (std::abs(sine) / (4 * w) + dt / 4)) << w;
    EXPECT_NEAR(p.gravity[1], sine / w, rounding * (std::abs(sine) / w + dt)) << w;
  }
}

}  // namespace
}  // namespace reachlab::dynamics
