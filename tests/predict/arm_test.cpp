// Criterion 2: the cost by differences of the torques as docs/theory/criteria.md, "Minimum torque change" prints them, optimality, and
// convergence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "sim/predict/predict.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

// A hand on the line and the force it exerts on the object, as functions of time.
struct LineMotion {
  std::function<double(double)> position, force;
};

std::array<double, 2> anglesOf(const experiment::Arm& arm, double x, double y) {
  const double reach = x * x + y * y, l1 = arm.length[0], l2 = arm.length[1];
  const double q2 = std::acos((reach - l1 * l1 - l2 * l2) / (2 * l1 * l2));
  return {std::atan2(y, x) - std::atan2(l2 * std::sin(q2), l1 + l2 * std::cos(q2)), q2};
}

// Everything by differences. Those that straddle the ends, where the hand's jerk begins at once, cost an error of the order of the step.
constexpr double kUsualStep = 1e-3;

double computeTorqueCost(const experiment::Arm& arm, double duration, const LineMotion& motion, double step = kUsualStep) {
  const auto torque = [&](double t) {
    const auto at = [&](double s) { return anglesOf(arm, -0.1 + motion.position(s) - arm.shoulder[0], -arm.shoulder[1]); };
    const auto q = at(t), before = at(t - step), after = at(t + step);
    const double w1 = (after[0] - before[0]) / (2 * step), w2 = (after[1] - before[1]) / (2 * step);
    const double a1 = (after[0] - 2 * q[0] + before[0]) / (step * step), a2 = (after[1] - 2 * q[1] + before[1]) / (step * step);
    const double i1 = arm.inertia[0], i2 = arm.inertia[1], m2 = arm.mass[1], l1 = arm.length[0], s2 = arm.centre[1];
    const double c = std::cos(q[1]), s = std::sin(q[1]), f = motion.force(t);
    const double first = (i1 + i2 + 2 * m2 * l1 * s2 * c + m2 * l1 * l1) * a1 + (i2 + m2 * l1 * s2 * c) * a2 -
                         m2 * l1 * s2 * (2 * w1 + w2) * w2 * s + arm.damping[0] * w1 -
                         (l1 * std::sin(q[0]) + arm.length[1] * std::sin(q[0] + q[1])) * f;
    const double second = (i2 + m2 * l1 * s2 * c) * a1 + i2 * a2 + m2 * l1 * s2 * s * w1 * w1 + arm.damping[1] * w2 -
                          arm.length[1] * std::sin(q[0] + q[1]) * f;
    return std::array<double, 2>{first, second};
  };
  const int steps = static_cast<int>(duration / step);
  double sum = 0;
  auto before = torque(0);
  for (int i = 0; i < steps; ++i) {
    const auto after = torque(duration * (i + 1) / steps);
    for (int k = 0; k < 2; ++k) sum += std::pow(after[k] - before[k], 2) / (duration / steps);
    before = after;
  }
  return sum;
}

LineMotion motionOf(const Prediction& p, const experiment::Experiment& e) {
  const auto held = [T = p.duration](double t) { return std::clamp(t, 0.0, T); };
  return {[&p, held](double t) { return p.handAt(held(t)).position; },
          [&p, &e, held](double t) {
            double x = 0, v = 0;
            p.massesAt(held(t), {&x, 1}, {&v, 1});
            return e.coupling->stiffness * (p.handAt(held(t)).position - x);
          }};
}

// In front of the shoulder the elbow hardly turns; on a way that leads away from it every term of the equations counts.
TEST(Arm, CostIsTheSquaredTorqueChangeOfThePrintedEquations) {
  experiment::Experiment away = dingwell();
  away.arm.shoulder = {-0.35, -0.2};
  for (const experiment::Experiment& e : {dingwell(), away}) {
    const auto p = predict(e, Criterion::MinTorqueChange);
    const LineMotion motion = motionOf(*p, e);
    const double coarse = computeTorqueCost(e.arm, p->duration, motion, 1e-3), fine = computeTorqueCost(e.arm, p->duration, motion, 5e-4);
    EXPECT_NEAR((2 * fine - coarse) / p->cost, 1, 1e-4);  // extrapolated to step 0
  }
}

TEST(Arm, NoSeededPerturbationLowersTheCost) {
  const experiment::Experiment e = dingwell();
  const auto p = predict(e, Criterion::MinTorqueChange);
  const LineMotion best = motionOf(*p, e);
  const double least = computeTorqueCost(e.arm, p->duration, best), T = p->duration;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> size(1e-4, 1e-3);  // [m] of the mass
  for (int trial = 0; trial < 12; ++trial) {
    // The mass moves by b sin^6(n pi t/T) more, zero with five derivatives at both ends; the hand by that and its acceleration m/k.
    const double b = (trial % 2 ? 1 : -1) * size(random), w = (1 + trial % 3) * M_PI / T, lag = 3.0 / 120;
    const auto acceleration = [=](double t) {
      const double s = std::sin(w * t), c = std::cos(w * t);
      return t < 0 || t > T ? 0 : b * w * w * (30 * std::pow(s, 4) * c * c - 6 * std::pow(s, 6));
    };
    const auto shift = [=](double t) { return t < 0 || t > T ? 0 : b * std::pow(std::sin(w * t), 6); };
    const LineMotion changed{[&](double t) { return best.position(t) + shift(t) + lag * acceleration(t); },
                             [&](double t) { return best.force(t) + 3 * acceleration(t); }};
    EXPECT_GT(computeTorqueCost(e.arm, T, changed), least);
  }
}

TEST(Arm, ProfilesAreKnownTo1e8) {
  for (const experiment::Experiment& e : {freely(dingwell(), {-0.1, 0, 0}, {0.15, 0, -0.08}), dingwell(), parallelPair()}) {
    const auto chosen = predict(e, Criterion::MinTorqueChange), fine = predict(e, Criterion::MinTorqueChange, {.unknowns = 90});
    EXPECT_NEAR(chosen->cost / fine->cost, 1, 1e-8);
    for (int i = 0; i <= 60; ++i) {
      const double t = chosen->duration * i / 60;
      EXPECT_NEAR(chosen->handAt(t).velocity, fine->handAt(t).velocity, 1e-8 * std::abs(fine->handPeak));
    }
  }
}

TEST(Arm, BringsTheObjectToRestAtTheTarget) {
  constexpr double kAtRest = 1e-10;
  const auto p = predict(parallelPair(), Criterion::MinTorqueChange);
  std::vector<double> x(2), v(2);
  p->massesAt(p->duration, x, v);
  const PredictedHand hand = p->handAt(p->duration);
  for (const double position : {x[0], x[1], hand.position}) EXPECT_NEAR(position, 0.2, kAtRest);
  for (const double rate : {v[0], v[1], hand.velocity, p->handAt(0).velocity}) EXPECT_NEAR(rate, 0, kAtRest);
}

TEST(Arm, MirroredPosturesOfAMirroredTaskCostTheSame) {
  experiment::Experiment right = dingwell(), left = dingwell();
  left.arm.elbowLeft = true;
  std::swap(left.task->start, left.task->target);
  const auto a = predict(right, Criterion::MinTorqueChange), b = predict(left, Criterion::MinTorqueChange);
  EXPECT_NEAR(a->cost / b->cost, 1, 1e-8);
  EXPECT_NEAR(a->handPeak / b->handPeak, 1, 1e-8);
}

}  // namespace
}  // namespace reachlab::predict
