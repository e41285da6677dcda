// Least hand jerk along curves and on surfaces: the straight line as oracle, the formula in curvature and torsion, and optimality.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "base/error.h"
#include "base/fault.h"
#include "base/math/gauss_legendre.h"
#include "sim/predict/predict.h"
#include "tests/predict/objects.h"
#include "tests/refusal.h"

namespace reachlab::predict {
namespace {

experiment::Experiment makeCurveExperiment(std::vector<std::string> formula, double from, double to, double duration) {
  return onCurve(makeChain(1, 1, 600, duration), std::move(formula), from, to);
}

experiment::Experiment makeSurfaceExperiment(std::vector<std::string> formula, std::vector<double> from, std::vector<double> to,
                                             double duration) {
  return onSurface(makeChain(1, 1, 600, duration), std::move(formula), std::move(from), std::move(to));
}

void expectMinimumJerk(const Prediction& p, double length) {
  const double T = p.duration;
  EXPECT_NEAR(p.distance, length, kProfile * length);
  EXPECT_NEAR(p.cost / (720 * length * length / std::pow(T, 5)), 1, kProfile);
  for (int i = 0; i <= 50; ++i) {
    const double s = i / 50.0;
    EXPECT_NEAR(p.handAt(s * T).velocity, 30 * length / T * s * s * (1 - s) * (1 - s), kProfile * p.handPeak);
    EXPECT_NEAR(p.handAt(s * T).position, length * s * s * s * (10 - 15 * s + 6 * s * s), kProfile * length);
  }
}

TEST(CurveJerk, OnAStraightLineUnevenlyRunIsTheMinimumJerk) {
  expectMinimumJerk(
      *predict(makeCurveExperiment({"0.05*(phi + 0.3*sin(phi))", "0", "0.02*(phi + 0.3*sin(phi))"}, 0.5, 4, 1.2), Criterion::MinHandJerk),
      std::hypot(0.05, 0.02) * (3.5 + 0.3 * (std::sin(4) - std::sin(0.5))));
}

TEST(SurfaceJerk, OnAPlaneUnevenlyCoveredIsTheMinimumJerkAlongTheChord) {
  const auto p = predict(makeSurfaceExperiment({"0.1*(u + u^3/5)", "0.1*v + 0.02*(u + u^3/5)", "0.05*v"}, {-0.8, 0.1}, {0.7, 0.9}, 0.9),
                         Criterion::MinHandJerk);
  const double x = 0.1 * (1.5 + (0.343 + 0.512) / 5), y = 0.1 * 0.8 + 0.2 * x, z = 0.05 * 0.8;
  expectMinimumJerk(*p, std::sqrt(x * x + y * y + z * z));
}

// Cost of an arc length s(t) on a curve of constant curvature and torsion (docs/theory/criteria.md, "Curves and surfaces"), by
// Gauss-Legendre.
struct Motion {
  double rate, acceleration, jerk;
};
double computeJerkCost(double curvature, double torsion, double T, const std::function<Motion(double)>& motion) {
  const GaussRule rule = makeGaussRule(80);
  double sum = 0;
  for (size_t i = 0; i < rule.node.size(); ++i) {
    const Motion m = motion(T * (rule.node[i] + 1) / 2);
    const double cube = m.rate * m.rate * m.rate;
    sum += rule.weight[i] * T / 2 *
           (std::pow(m.jerk - curvature * curvature * cube, 2) + std::pow(3 * curvature * m.rate * m.acceleration, 2) +
            std::pow(curvature * torsion * cube, 2));
  }
  return sum;
}

// The helix (R cos, R sin, p phi): curvature R / (R^2 + p^2), torsion p / (R^2 + p^2); p = 0 is the circle.
class Helix : public testing::TestWithParam<double> {};

TEST_P(Helix, CostIsTheFormulaInCurvatureAndTorsionAndNoneIsLower) {
  constexpr double kRadius = 0.1, kTurn = 3;
  const double pitch = GetParam(), square = kRadius * kRadius + pitch * pitch, curvature = kRadius / square, torsion = pitch / square;
  const experiment::Experiment e = makeCurveExperiment({"0.1*cos(phi)", "0.1*sin(phi)", std::to_string(pitch) + "*phi"}, 0, kTurn, 1);
  const auto p = predict(e, Criterion::MinHandJerk);
  EXPECT_NEAR(p->distance, kTurn * std::sqrt(square), 1e-12);
  const auto predicted = [&](double t, double bend, int waves) {
    constexpr double kStep = 1e-3;
    const PredictedHand h = p->handAt(t);
    // Jerk of the predicted motion by fourth-order differences of its acceleration, one-sided at the ends by symmetry of the stencil's
    // range.
    const double c = std::clamp(t, 2 * kStep, 1 - 2 * kStep);
    const auto a = [&](double s) { return p->handAt(s).acceleration; };
    double jerk = (8 * (a(c + kStep) - a(c - kStep)) - (a(c + 2 * kStep) - a(c - 2 * kStep))) / (12 * kStep);
    if (c != t) jerk += (t - c) * (a(c + kStep) - 2 * a(c) + a(c - kStep)) / (kStep * kStep);
    // Perturbation bend sin^4(waves pi t): zero with three derivatives at both ends.
    const double w = waves * M_PI, s1 = std::sin(w * t), c1 = std::cos(w * t);
    const double rate = 4 * w * s1 * s1 * s1 * c1, acceleration = w * w * (12 * s1 * s1 * c1 * c1 - 4 * std::pow(s1, 4)),
                 third = w * w * w * (24 * s1 * std::pow(c1, 3) - 40 * std::pow(s1, 3) * c1);
    return Motion{h.velocity + bend * rate, h.acceleration + bend * acceleration, jerk + bend * third};
  };
  constexpr double kDifferences = 5e-6;  // the jerk extrapolated at the ends limits this, not the prediction
  EXPECT_NEAR(computeJerkCost(curvature, torsion, 1, [&](double t) { return predicted(t, 0, 1); }) / p->cost, 1, kDifferences);

  // Minimum jerk in arc length is not optimal on a bent curve.
  const double length = p->distance;
  EXPECT_GT(computeJerkCost(curvature, torsion, 1,
                            [&](double t) {
                              return Motion{30 * length * t * t * (1 - t) * (1 - t), 60 * length * t * (1 - t) * (1 - 2 * t),
                                            60 * length * (1 - 6 * t + 6 * t * t)};
                            }),
            p->cost * 1.0001);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> bend(0.003, 0.01);
  for (int trial = 0; trial < 12; ++trial) {
    const double size = (trial % 2 ? 1 : -1) * bend(random) * length;
    EXPECT_GT(computeJerkCost(curvature, torsion, 1, [&](double t) { return predicted(t, size, 1 + trial % 3); }), p->cost);
  }
}
INSTANTIATE_TEST_SUITE_P(Pitches, Helix, testing::Values(0.0, 0.05));

TEST(CurveJerk, ProfileIsKnownTo1e8) {
  const experiment::Experiment e =
      makeCurveExperiment({"0.08*cos(phi) - 0.01*cos(4*phi)", "0.08*sin(phi) - 0.01*sin(4*phi)", "0"}, 1, 3, 1.5);
  const auto chosen = predict(e, Criterion::MinHandJerk), fine = predict(e, Criterion::MinHandJerk, {.unknowns = 220});
  for (int i = 0; i <= 60; ++i)
    EXPECT_NEAR(chosen->handAt(1.5 * i / 60).velocity, fine->handAt(1.5 * i / 60).velocity, kProfile * fine->handPeak);
}

TEST(SurfaceJerk, OnACylinderCostsNoMoreThanAlongTheHelixBetweenTheSamePoints) {
  const auto free = predict(makeSurfaceExperiment({"0.1*cos(u)", "0.1*sin(u)", "0.1*v"}, {0, 0}, {1.5, 1}, 1), Criterion::MinHandJerk);
  const auto helix = predict(makeCurveExperiment({"0.1*cos(phi)", "0.1*sin(phi)", "0.1*phi/1.5"}, 0, 1.5, 1), Criterion::MinHandJerk);
  EXPECT_LT(free->cost, helix->cost * (1 - 1e-6));
  EXPECT_GT(free->cost, 720 * (std::pow(2 * 0.1 * std::sin(0.75), 2) + 0.01));  // of the chord, which leaves the cylinder
}

std::string refusalOfJerk(const experiment::Experiment& e) {
  return refusalOf<RefusedError>([&] { (void)predict(e, Criterion::MinHandJerk); });
}

// Wherever the place lies: at a border of the pieces that the curve is taken in, or within one.
TEST(CurveJerk, IsRefusedWhereTheCurveIsNotSmoothWithKindAndPlace) {
  struct Broken {
    std::vector<std::string> formula;
    double from, to;
    const char *kind, *place;
  };
  for (const Broken& broken : {Broken{{"phi/10", "0.05*abs(phi)", "0"}, -1, 1, "a kink", "phi = 0"},
                               {{"phi/10", "0.05*abs(phi - 0.3)", "0"}, -1, 1, "a kink", "phi = 0.3"},
                               {{"phi/10", "0.05*abs(phi) + 0.02*phi^2", "0"}, -1, 1, "a kink", "phi = 0"},
                               // Kinks 1e-9 apart, which no sample sees.
                               {{"phi/10", "0.05*(abs(phi - 0.31234) - abs(phi - 0.31234 - 1e-9))", "0"}, -1, 1, "a kink", "phi = 0.31234"},
                               {{"phi/10", "0.05*abs(phi) + 0.02*phi^2", "0"}, -0.5, 0.9, "a kink", "phi = "},
                               {{"0.05*(phi + abs(phi))", "0.02*phi", "0"}, -1, 1, "a kink", "phi = 0"},
                               {{"phi/10", "0.01*sign(phi)", "0"}, -1, 1, "a jump of 0.02 m", "phi = 0"},
                               {{"phi/10", "0.05*atan2(0.3*sin(phi), cos(phi))", "0"}, 2, 4, "a jump of 0.314 m", "phi = 3.14159"},
                               {{"phi/10", "0.05*phi*abs(phi)", "0"}, -1, 1, "a step of its curvature", "phi = 0"},
                               {{"0.1*phi^3", "0.1*phi^2", "0"}, -1, 1, "a cusp", "phi = 0"}}) {
    for (const auto& e : {makeCurveExperiment(broken.formula, broken.from, broken.to, 1),
                          onCurve(chainModerate(), broken.formula, broken.from, broken.to)}) {
      const std::string refusal = refusalOfJerk(e);
      EXPECT_TRUE(holds(refusal, broken.kind)) << broken.formula[0] << ", " << broken.formula[1];
      EXPECT_TRUE(holds(refusal, broken.place)) << broken.formula[0] << ", " << broken.formula[1];
    }
  }
}

TEST(CurveJerk, BeginsAndEndsAtAKink) {
  for (const auto& [from, to] : {std::pair{-1.0, 0.0}, {0.0, 1.0}}) {
    expectMinimumJerk(
        *predict(makeCurveExperiment({"phi/10 + 0*cos(phi)", "0.05*abs(phi)", "0"}, from, to, 1), Criterion::MinHandJerk, asHand()),
        std::hypot(0.1, 0.05));
    EXPECT_GT(predict(makeCurveExperiment({"phi/10", "0.05*abs(phi) + 0.02*phi^2", "0"}, from, to, 1), Criterion::MinHandJerk)->cost, 0);
  }
}

TEST(CurveJerk, PassesAChangeOfPaceOfTheParameter) {
  for (const auto& [x, length] : {std::pair{"phi/10 + 0.05*abs(phi)", 0.2}, {"phi/10 + 0.05*abs(phi - 0.3)", 0.17}})
    expectMinimumJerk(*predict(makeCurveExperiment({x, "0", "0"}, -1, 1, 1), Criterion::MinHandJerk, asHand()), length);
}

// The nodes of a motion of few unknowns lie on either side of it.
TEST(CurveJerk, DoesNotStepOverANarrowBump) {
  const std::string formula = "0.001*exp(-(phi - 0.0137)^2/(2*0.0005^2))";
  EXPECT_NE(refusalOfJerk(makeCurveExperiment({"phi/10", formula, "0"}, -1, 1, 1)), "");
  const auto wide =
      predict(makeCurveExperiment({"phi/10", "0.001*exp(-(phi - 0.137)^2/(2*0.1^2))", "0"}, -1, 1, 1), Criterion::MinHandJerk);
  EXPECT_GT(wide->cost, 28.8 * 1.01);
}

TEST(SurfaceJerk, IsRefusedAcrossARidgeOrAStep) {
  EXPECT_TRUE(holds(refusalOfJerk(makeSurfaceExperiment({"u", "0.1 - 0.5*abs(u)", "v"}, {-0.1, 0}, {0.1, 0.05}, 1)), "a kink, a jump"));
  EXPECT_TRUE(holds(refusalOfJerk(makeSurfaceExperiment({"u", "0.01*sign(u - 0.013)", "v"}, {-0.1, 0}, {0.1, 0.05}, 1)), "a kink, a jump"));
}

// What two samples of the way have between them is seen by the sides of the formula's own operations.
TEST(SurfaceJerk, IsRefusedAcrossAKinkThatNoSampleSees) {
  const std::string refusal =
      refusalOfJerk(makeSurfaceExperiment({"u", "0.5*(abs(u - 0.0123) - abs(u - 0.0123 - 1e-9))", "v"}, {-0.1, 0}, {0.1, 0.05}, 1));
  EXPECT_TRUE(holds(refusal, "a kink, a jump"));
  EXPECT_TRUE(holds(refusal, "abs("));
}

// A short ridge across the way that lies between two of the movement's nodes: smooth, and on no parameter line through the start. Interval
// arithmetic round the way finds it, and lets a broad one pass.
TEST(SurfaceJerk, IsRefusedOverABumpThatNoNodeSees) {
  const auto over = [](const std::string& width) {
    const std::string ridge = "0.02*" + width + "*exp(-((u - 0.0111)/" + width + ")^2 - ((v - 0.0165)/0.003)^2)";
    return makeSurfaceExperiment({"u", "v", "0.1*u*v + " + ridge}, {-0.1, 0}, {0.1, 0.03}, 1);
  };
  const std::string refusal = refusalOfJerk(over("1e-9"));
  EXPECT_TRUE(holds(refusal, "a bump too narrow to be resolved at u = 0.0111"));
  const auto broad = predict(over("0.03"), Criterion::MinHandJerk);
  for (const std::string& warning : broad->warnings) EXPECT_EQ(warning.find("too narrow"), std::string::npos) << warning;
}

// Finite differences of a fixed step were wrong by 6e-5 of the cost where parameters are metres, and refused narrow hills.
TEST(SurfaceJerk, DoesNotDependOnTheUnitOfTheParameters) {
  const auto hill = [](const std::string& unit, double scale, double width) {
    const std::string u = "(u*" + unit + ")", v = "(v*" + unit + ")", w = std::to_string(width);
    return predict(makeSurfaceExperiment({u, "0.02*" + w + "/0.03*exp(-(" + u + "^2 + " + v + "^2)/(2*" + w + "^2))", v},
                                         {-0.1 * scale, 0.01 * scale}, {0.1 * scale, 0.01 * scale}, 1),
                   Criterion::MinHandJerk);
  };
  for (const double width : {0.03, 0.01}) {
    const auto metres = hill("1", 1, width), tenths = hill("0.1", 10, width), kilometres = hill("1000", 1e-3, width);
    EXPECT_NEAR(tenths->cost / metres->cost, 1, 1e-11);
    EXPECT_NEAR(kilometres->cost / metres->cost, 1, 1e-11);
    for (int i = 0; i <= 50; ++i)
      EXPECT_NEAR(metres->handAt(i / 50.0).velocity, tenths->handAt(i / 50.0).velocity, kProfile * metres->handPeak);
  }
}

// The straight start goes over the top, to either side of which it is lower: a way round is looked for also where the parameter across
// does not change from start to target, and where the formula has no value at other pairs of parameters.
TEST(SurfaceJerk, GoesRoundAHillHoweverItsParametersCount) {
  const auto cost = [](const std::string& x, double from, double to) {
    return predict(makeSurfaceExperiment({x, "0.05*exp(-(" + x + "^2 + v^2)/(2*0.02^2))", "v"}, {from, 0}, {to, 0}, 1),
                   Criterion::MinHandJerk)
        ->cost;
  };
  const double round = cost("u", -0.1, 0.1);
  const auto over = predict(makeCurveExperiment({"phi", "0.05*exp(-phi^2/(2*0.02^2))", "0"}, -0.1, 0.1, 1), Criterion::MinHandJerk);
  EXPECT_LT(round, 0.9 * over->cost);
  EXPECT_NEAR(cost("log(u)", std::exp(-0.1), std::exp(0.1)) / round, 1, 1e-6);
}

TEST(Point, IsBehindItsSpringOnALineAndTheHandElsewhereUnlessAsked) {
  const auto line = makeChain(1, 1, 600, 1);
  const auto straight = makeCurveExperiment({"0.2*(phi + 0.1*sin(2*pi*phi))", "0", "0"}, 0, 1, 1);
  const PredictOptions behind{.point = PointIs::BehindSpring};
  const auto onLine = predict(line, Criterion::MinHandJerk), onCurve = predict(straight, Criterion::MinHandJerk);
  const auto handOnLine = predict(line, Criterion::MinHandJerk, asHand()),
             behindOnCurve = predict(straight, Criterion::MinHandJerk, behind);
  EXPECT_EQ(onLine->point, PointIs::BehindSpring);
  EXPECT_EQ(onCurve->point, PointIs::Hand);
  EXPECT_EQ(handOnLine->point, PointIs::Hand);
  EXPECT_EQ(behindOnCurve->point, PointIs::BehindSpring);
  EXPECT_EQ(predict(chainModerate(), Criterion::MinHandJerk)->point, std::nullopt);
  EXPECT_NEAR(handOnLine->cost / onCurve->cost, 1, kProfile);
  EXPECT_NEAR(behindOnCurve->cost / onLine->cost, 1, kProfile);
  EXPECT_GT(onLine->cost, handOnLine->cost * 1.0003);
  expectMinimumJerk(*handOnLine, 0.2);
  EXPECT_THROW(predict(chainModerate(), Criterion::MinHandJerk, behind), FaultError);
}

}  // namespace
}  // namespace reachlab::predict
