// The methods alone, on equations whose solutions are known.
#include <gtest/gtest.h>

#include <limits>

#include "sim/dynamics/hand/hand_function.h"
#include "sim/dynamics/methods/abm.h"
#include "sim/dynamics/methods/dense_output.h"
#include "sim/dynamics/methods/rk4.h"
#include "sim/dynamics/methods/stiff.h"

namespace reachlab::dynamics {
namespace {

/// x'' = w^2 (h - x) - 2 c x', and a second number x2' = -fast (x2 - h) that follows the hand's y.
struct Follower {
  static constexpr int kStates = 3;
  static constexpr bool kSecondOrder = false;
  static constexpr Hooks kHas{};
  using State = Numbers<3>;
  using Hand = HandSample;
  double w = 3, c = 0, fast = 1, second = 2;  // x2(0)
  mutable int evaluations = 0;
  int brokenAt = 1 << 30;  // evaluations, from which on nothing is a number
  static constexpr int states() noexcept { return 3; }
  Hand handAt(const HandSegment& hand, double s) const noexcept { return sampleAt(hand, s); }
  Hand handOf(const HandSample& hand) const noexcept { return hand; }
  double scale(int) const noexcept { return 1; }
  void rate(const Hand& hand, const State& y, State& dy) const noexcept {
    const double broken = ++evaluations >= brokenAt ? std::numeric_limits<double>::quiet_NaN() : 0;
    dy.values = {y[1], w * w * (hand.position.x - y[0]) - 2 * c * y[1] + broken, -fast * (y[2] - hand.position.y)};
  }
};

// A hand along 0.3 - 0.2 t + t^2/2 and 1 + t: the undamped x follows it but for a swing, x2 but for 1/fast.
HandSample hand(double t) { return {{0.3 - 0.2 * t + 0.5 * t * t, 1 + t, 0}, {}, true}; }
std::array<double, 3> truth(const Follower& f, double t) {
  const double drift = -1 / (f.w * f.w), a = 1 - 0.3 - drift, b = (0 + 0.2) / f.w;  // x(0) = 1, x'(0) = 0
  const double follow = 1 - 1 / f.fast;
  return {hand(t).position.x + drift + a * std::cos(f.w * t) + b * std::sin(f.w * t),
          -0.2 + t - a * f.w * std::sin(f.w * t) + b * f.w * std::cos(f.w * t), follow + t + (f.second - follow) * std::exp(-f.fast * t)};
}

struct Followed {
  double error = 0;
  std::uint64_t rhs = 0, most = 0;  // right-hand sides, and most in a tick
  StepStatus status = StepStatus::Ok;
};
template <class Method>
Followed follow(const Follower& f, Method& method, double seconds, double dt) {
  Followed run;
  Numbers<3> y, next;
  y.values = {1, 0, f.second};
  const int ticks = static_cast<int>(std::lround(seconds / dt));
  for (int i = 0; i < ticks; ++i) {
    std::uint64_t rhs = 0;
    run.status = method.step(f, makeSegment(hand, i * dt, dt), dt, y, next, rhs);
    if (run.status != StepStatus::Ok) return run;
    y = next;
    run.rhs += rhs;
    run.most = std::max(run.most, rhs);
  }
  const std::array<double, 3> expected = truth(f, seconds);
  for (int i = 0; i < 3; ++i) run.error = std::max(run.error, std::abs(y[i] - expected[i]));
  EXPECT_EQ(run.rhs, static_cast<std::uint64_t>(f.evaluations)) << "each is counted";
  return run;
}
template <class Method>
Followed follow(Follower f, double tolerance, double seconds, double dt) {
  Method method(f, tolerance);
  return follow(f, method, seconds, dt);
}

TEST(Method, Rk4IsOfFourthOrder) {
  const double whole = follow<Rk4<Follower>>({}, 0, 2, 0.1).error, half = follow<Rk4<Follower>>({}, 0, 2, 0.05).error;
  EXPECT_NEAR(whole / half, 16, 2);
  EXPECT_EQ(follow<Rk4<Follower>>({}, 0, 2, 0.1).most, 4u);
}

TEST(Method, TheAdaptivePairKeepsToItsTolerance) {
  EXPECT_LT(follow<Adaptive<Follower>>({}, 0, 2, 0.1).error, 1e-11) << "1e-13 a sub-step";
  for (const double tolerance : {1e-6, 1e-9}) {
    const Followed run = follow<Adaptive<Follower>>({.w = 30}, tolerance, 2, 0.5);
    EXPECT_LT(run.error, 2000 * tolerance) << "some hundred sub-steps of what 30 rad/s makes of it";
    EXPECT_GT(run.error, 1e-4 * tolerance) << "and not much finer";
  }
  EXPECT_EQ(follow<Adaptive<Follower>>({.w = 0.1}, 1e-3, 1, 0.1).most, 12u) << "one sub-step where it is enough";
}

// Twelve right-hand sides a sub-step; an eighth order takes steps of about a radian at 1e-9.
TEST(Method, TheAdaptivePairIsAsLongInItsStepsAsItsOrderAllows) {
  const Followed loose = follow<Adaptive<Follower>>({.w = 30}, 1e-6, 2, 0.1), fine = follow<Adaptive<Follower>>({.w = 30}, 1e-12, 2, 0.1);
  EXPECT_GT(fine.rhs, 2 * loose.rhs);
  EXPECT_LT(fine.rhs, 6 * loose.rhs) << "1e6 to the eighth root";
  EXPECT_LT(loose.rhs, 90u * 12) << "60 radians";
}

TEST(Method, WhatNeedsMoreThanAThousandRightHandSidesATickIsCapped) {
  EXPECT_EQ(follow<Adaptive<Follower>>({.w = 1e5}, 0, 0.1, 0.1).status, StepStatus::Capped);
  EXPECT_EQ(follow<Stiff<Follower>>({.w = 1e6}, 1e-14, 0.1, 0.1).status, StepStatus::Capped);
  EXPECT_EQ(kMaxRhsPerTick, 1000);
  Follower f{.w = 1e5};
  Adaptive<Follower> method(f, 0);
  Numbers<3> y, next;
  y.values = {1, 0, 2};
  std::uint64_t rhs = 0;
  EXPECT_EQ(method.step(f, makeSegment(hand, 0, 0.1), 0.1, y, next, rhs), StepStatus::Capped);
  EXPECT_GT(rhs, 900u);
  EXPECT_LE(rhs, 1000u);
  EXPECT_EQ(rhs, static_cast<std::uint64_t>(f.evaluations));
}

TEST(Method, ANumberThatIsNoneIsTold) {
  for (const int when : {1, 5}) {
    EXPECT_EQ(follow<Rk4<Follower>>({.brokenAt = std::min(when, 4)}, 0, 0.1, 0.1).status, StepStatus::NotFinite) << when;
    EXPECT_EQ(follow<Adaptive<Follower>>({.brokenAt = when}, 0, 0.1, 0.1).status, StepStatus::NotFinite) << when;
    EXPECT_EQ(follow<Stiff<Follower>>({.brokenAt = when}, 0, 0.1, 0.1).status, StepStatus::NotFinite) << when;
    EXPECT_EQ((follow<AbmWith<Follower, Adaptive>>({.brokenAt = when}, 0, 0.1, 0.1).status), StepStatus::NotFinite) << when;
  }
  for (const int when : {20, 300, 301})  // in the middle of its history
    EXPECT_EQ((follow<AbmWith<Follower, Adaptive>>({.w = 1, .brokenAt = when}, 0, 1, 1e-3).status), StepStatus::NotFinite) << when;
}

TEST(Method, RadauIsOfFifthOrderAndBearsAnyDamping) {
  EXPECT_LT(follow<Stiff<Follower>>({}, 0, 2, 0.1).error, 1e-7);
  for (const double fast : {1e4, 1e7}) {
    const Followed run = follow<Stiff<Follower>>({.fast = fast, .second = 1 - 1 / fast}, 1e-8, 2, 0.1);
    EXPECT_EQ(run.status, StepStatus::Ok);
    EXPECT_LT(run.error, 1e-5) << fast;
    EXPECT_LT(run.rhs, 8000u) << "whatever the rate: " << fast;
  }
  // A sub-step's error falls with its sixth power, so that a millionth of the tolerance takes ten times as many.
  const Followed loose = follow<Stiff<Follower>>({.w = 20}, 1e-5, 1, 1), fine = follow<Stiff<Follower>>({.w = 20}, 1e-8, 1, 1);
  EXPECT_LT(loose.error, 2e-3);
  EXPECT_LT(fine.error, 2e-6);
  EXPECT_LT(static_cast<double>(fine.rhs) / static_cast<double>(loose.rhs), 5);
}

/// The slopes are the hand's x and y, whatever the state is.
struct Quadrature {
  static constexpr int kStates = 2;
  static constexpr bool kSecondOrder = false;
  static constexpr Hooks kHas{};
  using State = Numbers<2>;
  using Hand = HandSample;
  static constexpr int states() noexcept { return 2; }
  Hand handAt(const HandSegment& hand, double s) const noexcept { return sampleAt(hand, s); }
  Hand handOf(const HandSample& hand) const noexcept { return hand; }
  double scale(int) const noexcept { return 1; }
  void rate(const Hand& hand, const State&, State& dy) const noexcept { dy.values = {hand.position.x, hand.position.y}; }
};

// The corrector is of order eight: what grows by powers up to the seventh it sums up without an error. The first ticks are the pair's.
TEST(Method, AdamsSumsPowersUpToTheSeventhExactly) {
  const auto slope = [](double t) { return HandSample{{8 * std::pow(t, 7) + 3 * t * t, 5 * std::pow(t, 4), 0}, {}, true}; };
  AbmWith<Quadrature, Adaptive> method({}, 1e9);
  Numbers<2> y, next;
  y.values = {0, 0};
  std::uint64_t rhs = 0;
  for (int i = 0; i < 30; ++i) {
    ASSERT_EQ(method.step({}, makeSegment(slope, i * 0.05, 0.05), 0.05, y, next, rhs), StepStatus::Ok);
    y = next;
    const double t = (i + 1) * 0.05;
    EXPECT_NEAR(y[0], std::pow(t, 8) + t * t * t, 1e-12 * (1 + std::pow(t, 8))) << i;
    EXPECT_NEAR(y[1], std::pow(t, 5), 1e-12 * (1 + std::pow(t, 5))) << i;
  }
  EXPECT_EQ(rhs, 14u + 5 * 13 + 24);
}

// Where a tick's correction is beyond its tolerance the pair does it, and the whole keeps to what the pair would.
TEST(Method, AdamsLeavesToThePairWhatItCannotDo) {
  using Abm = AbmWith<Follower, Adaptive>;
  const Followed run = follow<Abm>({.w = 30}, 1e-10, 2, 0.02);
  EXPECT_LT(run.error, 1e-6);
  EXPECT_GT(run.rhs, 100u * 12) << "each tick of 0.6 rad is";
  const Followed within = follow<Abm>({.w = 3}, 1e-10, 2, 0.01);
  EXPECT_LT(within.error, 2e-9);
  EXPECT_LT(within.rhs, 200u * 2 + 7 * 14 + 40);
}

TEST(Method, AdamsTakesOneRightHandSideATickOnceItHasAHistory) {
  using Abm = AbmWith<Follower, Adaptive>;
  const Follower f{.w = 1};
  Abm method(f, 1e-8);
  Numbers<3> y, next;
  y.values = {1, 0, 2};
  for (int i = 0; i < 20; ++i) {
    std::uint64_t rhs = 0;
    ASSERT_EQ(method.step(f, makeSegment(hand, i * 1e-3, 1e-3), 1e-3, y, next, rhs), StepStatus::Ok);
    y = next;
    if (i < 6) EXPECT_EQ(rhs, i == 0 ? 14u : 13u) << i;
    else EXPECT_EQ(rhs, 1u) << i;
  }
  method.restart();
  std::uint64_t rhs = 0;
  (void)method.step(f, makeSegment(hand, 0.02, 1e-3), 1e-3, y, next, rhs);
  EXPECT_EQ(rhs, 14u) << "its history is forgotten";
  rhs = 0;
  (void)method.step(f, makeSegment(hand, 0.021, 5e-4), 5e-4, y, next, rhs);
  EXPECT_EQ(rhs, 14u) << "and is of no use for another step";
}

TEST(Method, ASubStepGrowsAsItsErrorAllows) {
  using dop853::growth;
  EXPECT_NEAR(growth(1, 5), 0.9, 1e-15);
  EXPECT_NEAR(growth(256, 5), 0.45, 1e-15);
  EXPECT_NEAR(growth(1 / 256.0, 5), 1.8, 1e-15);
  EXPECT_NEAR(growth(1 / 256.0, 1), 1, 1e-15) << "not right after a rejection";
  EXPECT_EQ(growth(1e-300, 5), 5);
  EXPECT_EQ(growth(0, 100), 0.9 * std::pow(1e-12, -0.125));
  EXPECT_EQ(growth(1e9, 5), 0.2);
  EXPECT_EQ(growth(std::numeric_limits<double>::infinity(), 5), 0.1);
  EXPECT_EQ(growth(std::numeric_limits<double>::quiet_NaN(), 5), 0.1);
}

// The conditions on the sums of b_j c_j^k, and that each stage is at its own time.
TEST(Method, TheCoefficientsOfThePairAreOfTheirOrders) {
  const auto moment = [](const double(&weights)[dop853::kStages], int k) {
    double sum = 0;
    for (int j = 0; j < dop853::kStages; ++j) sum += weights[j] * std::pow(dop853::kC[j], k);
    return sum;
  };
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(moment(dop853::kB, k), 1.0 / (k + 1), 2e-14) << k;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(moment(dop853::kError3, k), 0, 2e-14) << k;
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(moment(dop853::kError5, k), 0, 2e-14) << k;
  EXPECT_GT(std::abs(moment(dop853::kError3, 3)), 1e-4);
  EXPECT_GT(std::abs(moment(dop853::kError5, 5)), 1e-6);
  for (int stage = 0; stage < dop853::kStages; ++stage) {
    double sum = 0;
    for (int j = 0; j < stage; ++j) sum += dop853::kA[stage][j];
    EXPECT_NEAR(sum, dop853::kC[stage], 2e-14) << stage;
  }
  // Stages before the last have at least order two, those that count more: sum a_ij c_j = c_i^2/2.
  for (int stage = 2; stage < dop853::kStages; ++stage) {
    double sum = 0;
    for (int j = 0; j < stage; ++j) sum += dop853::kA[stage][j] * dop853::kC[j];
    EXPECT_NEAR(sum, dop853::kC[stage] * dop853::kC[stage] / 2, 1e-13) << stage;
  }
}

const auto kUnit = [](int, double) { return 1.0; };

/// One step of h of the pair for x'' = -x from (1, 0), whose solution is the cosine.
struct OneStep {
  double estimate = 0, error = 0;  // at its end
  double within = 0;               // the largest error of its dense output
  explicit OneStep(double h) {
    const auto rate = [](double, const Numbers<2>& y, Numbers<2>& dy) { dy.values = {y[1], -y[0]}; };
    auto k = dop853::makeStages<2>(2);
    Numbers<2> y, next, at;
    y.values = {1, 0};
    rate(0, y, k[0]);
    estimate = dop853::attempt<2>(rate, kUnit, 0, h, y, k, next);
    error = std::hypot(next[0] - std::cos(h), next[1] + std::sin(h));
    const auto dense = dop853::makeDenseOutput<2>(rate, 0, h, y, k, next);
    for (int i = 0; i <= 40; ++i) {
      dense.at(i / 40.0, at);
      within = std::max({within, std::abs(at[0] - std::cos(i / 40.0 * h)), std::abs(at[1] + std::sin(i / 40.0 * h))});
    }
  }
};

TEST(Method, AStepOfThePairErrsByItsNinthPowerAndEstimatesMore) {
  const OneStep whole(1), half(0.5);
  EXPECT_NEAR(std::log2(whole.error / half.error), 9, 0.5);
  EXPECT_GT(whole.estimate, whole.error);
  EXPECT_NEAR(std::log2(whole.estimate / half.estimate), 8, 1);
  const auto still = [](double, const Numbers<2>&, Numbers<2>& dy) { dy.values = {0, 0}; };
  auto k = dop853::makeStages<2>(2);
  Numbers<2> y, next;
  y.values = {1, 2};
  still(0, y, k[0]);
  EXPECT_EQ(dop853::attempt<2>(still, kUnit, 0, 1, y, k, next), 0) << "nothing moves";
  EXPECT_EQ(next[1], 2);
}

TEST(DenseOutput, FollowsTheMotionWithinAStepToOrderSeven) {
  EXPECT_LT(OneStep(0.5).within, 1e-8);
  // A local error of order 8 falls 256-fold when the step is halved; 100 leaves room for the next order.
  EXPECT_GT(OneStep(1).within / OneStep(0.5).within, 100);
  EXPECT_GT(OneStep(0.5).within / OneStep(0.25).within, 100);
}

}  // namespace
}  // namespace reachlab::dynamics
