// Least hand jerk with a chain or a parallel object on bent curves: the straight line as oracle, the program's own simulator as judge.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "constraints/geometry/arc_curve.h"
#include "sim/predict/curve/curve_object.h"
#include "sim/predict/predict.h"
#include "tests/predict/arrival.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

experiment::Experiment onCircle(experiment::Experiment e, double radius) {
  const std::string r = std::to_string(radius);
  return onCurve(std::move(e), {r + "*sin(phi)", r + "*(1 - cos(phi))", "0"}, 0, 0.2 / radius);
}

experiment::Experiment onEllipse(experiment::Experiment e) { return onCurve(std::move(e), {"0", "0.1*cos(phi)", "0.06*sin(phi)"}, 0.2, 3); }

// Largest difference of any velocity, of the hand's peak.
double compare(const Prediction& a, const Prediction& b) {
  const auto n = static_cast<size_t>(b.massCount());
  std::vector<double> x(n), v(n), y(n), w(n);
  double most = 0;
  for (int i = 0; i <= 100; ++i) {
    const double t = b.duration * i / 100;
    a.massesAt(t, x, v), b.massesAt(t, y, w);
    most = std::max(most, std::abs(a.handAt(t).velocity - b.handAt(t).velocity));
    for (size_t m = 0; m < n; ++m) most = std::max({most, std::abs(v[m] - w[m]), std::abs(x[m] - y[m]) / b.duration});
  }
  return most / std::abs(b.handPeak);
}

TEST(CurveObject, OnAStraightLineUnevenlyRunItIsTheLinearPrediction) {
  for (const experiment::Experiment& e : {chainModerate(), parallelPair(), damped(chainModerate(), 1, 5), makeChain(10, 0.3, 600, 1.35)}) {
    const auto line = predict(e, Criterion::MinHandJerk);
    const auto curve = predict(onCurve(e, {"0.2*(phi + 0.1*sin(2*pi*phi))", "0", "0"}, 0, 1), Criterion::MinHandJerk);
    EXPECT_LT(compare(*curve, *line), kProfile);
    EXPECT_NEAR(curve->cost / line->cost, 1, kProfile);
    EXPECT_EQ(curve->travelTime, line->travelTime);
  }
}

// Masses that swing beyond either end of the task are still on the curve, the way between as long as it is.
TEST(ArcCurve, GoesOnBehindItsStartAsBeyondItsTarget) {
  constexpr double kRadius = 0.1;
  const experiment::Experiment e = onCurve(chainModerate(), {"0.1*cos(phi)", "0.1*sin(phi)", "0"}, 0.5, 1.5);
  for (const constraints::Along along : {constraints::Along::ArcLength, constraints::Along::Parameter}) {
    const constraints::ArcCurve arc(constraints::makeConstraint(e.constraint), 0.5, 1.5, along);
    const double perRadian = arc.length();
    EXPECT_LT(arc.lowest(), -0.1 * arc.length());
    EXPECT_GT(arc.highest(), 1.1 * arc.length());
    for (double s = arc.lowest(); s < arc.highest(); s += 0.05 * arc.length()) {
      const double phi = 0.5 + s / perRadian;
      const auto at = arc.expand<3>(s);
      EXPECT_LT(norm(at[0] - kRadius * Vec3{std::cos(phi), std::sin(phi), 0}), 1e-9) << s;
      EXPECT_LT(norm(at[1] - kRadius / perRadian * Vec3{-std::sin(phi), std::cos(phi), 0}), 1e-7) << s;
    }
  }
}

// Masses that hang on the hand alone have one frequency and one decay rate each.
TEST(CurveObject, TheBoundOfItsRatesIsMetByParallelMasses) {
  experiment::Experiment e = parallelPair();
  e.object.stiffness = {0.3, 1.2};
  double most = 0;
  for (size_t i = 0; i < e.object.masses.size(); ++i) most = std::max(most, std::sqrt(e.object.stiffness[i] / e.object.masses[i]));
  EXPECT_NEAR(boundRate(makeLineObject(e, 0, 0)), most, 1e-12);
  e.object.damping = {6, 6};
  EXPECT_NEAR(boundRate(makeLineObject(e, 0, 0)), most + 6 / e.object.masses[1], 1e-12);
}

// The way turns by L/R; what that changes is even in it.
TEST(CurveObject, OnWiderAndWiderCirclesItComesToTheLineWithTheSquareOfTheCurvature) {
  constexpr double kRatio = 0.05;  // what the fourth power leaves at 1 m
  for (const experiment::Experiment& e : {chainModerate(), parallelPair()}) {
    const auto line = predict(e, Criterion::MinHandJerk);
    const auto from = [&](double radius) { return compare(*predict(onCircle(e, radius), Criterion::MinHandJerk), *line); };
    EXPECT_LT(from(1000), 4e-8);  // (0.2 m / 1 km)^2
    EXPECT_NEAR(from(1) / from(2), 4, 4 * kRatio);
  }
}

TEST(CurveObject, ArrivesAtRestInTheSimulator) {
  constexpr double kAtRest = 1e-10;   // [m], [m/s]
  constexpr double kOnTheWay = 1e-9;  // [m] between the masses' collocation points
  for (const experiment::Experiment& e :
       {onEllipse(chainModerate()), onEllipse(damped(chainModerate(), 1, 5)), onEllipse(parallelPair()), onCircle(chainModerate(), 0.08),
        onCurve(damped(parallelPair(), 1, 5), {"0.05*cos(phi)", "0.02*phi", "0.05*sin(phi)"}, 1, 4)}) {
    const auto p = predict(e, Criterion::MinHandJerk);
    const CurveArrival arrival = simulateOn(e, *p, {"adaptive", 0.001, 1e-13});
    EXPECT_LT(arrival.position, kAtRest);
    EXPECT_LT(arrival.velocity, kAtRest);
    EXPECT_LT(arrival.along, kOnTheWay);
    const PredictedHand first = p->handAt(0), last = p->handAt(p->duration);
    for (const double rest :
         {first.position, first.velocity, first.acceleration, last.position - p->distance, last.velocity, last.acceleration})
      EXPECT_NEAR(rest, 0, kAtRest);
  }
}

// Motions of fewer unknowns are among those of more, and all of them arrive: none may cost less.
TEST(CurveObject, AMotionOfFewerUnknownsCostsMore) {
  constexpr double kRounding = 1e-9;
  for (const experiment::Experiment& e : {onEllipse(chainModerate()), onEllipse(damped(parallelPair(), 1, 5))}) {
    const auto best = predict(e, Criterion::MinHandJerk);
    double before = INFINITY;
    for (const int unknowns : {20, 30, 40, 50}) {
      const double cost = predict(e, Criterion::MinHandJerk, {.unknowns = unknowns})->cost;
      EXPECT_LT(cost, before * (1 + kRounding));
      EXPECT_GT(cost, best->cost * (1 - kRounding));
      before = cost;
    }
  }
}

TEST(CurveObject, ErrorFallsWithTheUnknownsTo1e8) {
  const auto with = [](const experiment::Experiment& e, int unknowns) {
    return predict(e, Criterion::MinHandJerk, {.unknowns = unknowns});
  };
  const experiment::Experiment bent = onEllipse(chainModerate()),
                               straight = onCurve(chainModerate(), {"0.2*(phi + 0.1*sin(2*pi*phi))", "0", "0"}, 0, 1);
  const auto settled = with(bent, 130), linear = predict(chainModerate(), Criterion::MinHandJerk);
  double before = INFINITY;
  for (const int unknowns : {24, 36, 54, 81}) {
    const double onBent = compare(*with(bent, unknowns), *settled), onStraight = compare(*with(straight, unknowns), *linear);
    EXPECT_LT(std::max(onBent, onStraight), before / 3);
    before = std::max(onBent, onStraight);
  }
  EXPECT_LT(before, kProfile);
  EXPECT_LT(compare(*predict(bent, Criterion::MinHandJerk), *settled), kProfile);
  EXPECT_LT(compare(*predict(onEllipse(parallelPair()), Criterion::MinHandJerk), *with(onEllipse(parallelPair()), 130)), kProfile);
}

TEST(CurveObject, MayArriveAtTheVeryEndOfACurve) {
  experiment::Experiment e = chainModerate();
  e.constraint = {};
  e.constraint.name = "logarithmic-spiral";
  const constraints::Constraint curve = constraints::makeConstraint(e.constraint);
  e.task->target = {curve.domain[0].hi};
  e.task->start = {curve.domain[0].hi - 2};
  EXPECT_GT(predict(e, Criterion::MinHandJerk)->cost, 0);
}

TEST(CurveObject, IsRefusedWhereGravityPullsAlongTheCurve) {
  experiment::Experiment heavy = onEllipse(chainModerate());
  heavy.object.gravity = {0, -9.81, 0};
  EXPECT_THROW(predict(heavy, Criterion::MinHandJerk), RefusedError);
  heavy.object.gravity = {-9.81, 0, 0};  // across the ellipse's plane
  EXPECT_NO_THROW(predict(heavy, Criterion::MinHandJerk));
}

}  // namespace
}  // namespace reachlab::predict
