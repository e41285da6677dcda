// The parts that the predictions found by iteration are made of: each by its own law, derivatives by differences.
#include "sim/predict/transcription/transcription.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/math/gauss_legendre.h"
#include "sim/predict/line/flat_output.h"
#include "sim/predict/line/modes.h"
#include "sim/predict/numerics/hyper_dual.h"
#include "sim/predict/transcription/path_check.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double kStep = 1e-5;

// Largest difference of a derivative from central differences of f along each unit vector.
template <class F, class Column>
double worstColumn(const Vector& at, const F& f, const Column& derivative) {
  double worst = 0;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    Vector before = at, after = at;
    before(i) -= kStep, after(i) += kStep;
    worst = std::max(worst, ((f(after) - f(before)) / (2 * kStep) - derivative(i)).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(RestToRestBasis, GoesFromZeroToOneOrBackWithEveryDerivativeAtRest) {
  for (const int order : {1, 2, 3, 5, 7}) {
    constexpr int kUnknowns = 6;
    const RestToRestBasis basis(order, kUnknowns);
    EXPECT_EQ(basis.order(), order);
    EXPECT_EQ(basis.columns(), kUnknowns + 1);
    const GaussRule rule = makeGaussRule(30);
    for (int column = 0; column <= kUnknowns; ++column) {
      EXPECT_NEAR(valueAt(basis.derivative(column, 0), -1), 0, 1e-13) << order << column;
      EXPECT_NEAR(valueAt(basis.derivative(column, 0), 1), column == 0 ? 1 : 0, 1e-13) << order << column;
      for (int m = 1; m < order; ++m)
        for (const double end : {-1.0, 1.0})
          EXPECT_NEAR(valueAt(basis.derivative(column, m), end), 0, 1e-9 * std::pow(10, m)) << order << column << m;
      for (int other = 1; other <= kUnknowns; ++other) {  // the highest derivatives are orthonormal, but for the length of [-1, 1]
        double product = 0;
        for (std::size_t i = 0; i < rule.node.size(); ++i)
          product += rule.weight[i] * valueAt(basis.derivative(column, order), rule.node[i]) *
                     valueAt(basis.derivative(other, order), rule.node[i]);
        EXPECT_NEAR(product, column == other ? 2 : 0, 1e-7) << order << column << other;
      }
      for (int m = 0; m < order; ++m) {
        const double x = 0.3, slope = (valueAt(basis.derivative(column, m), x + kStep) - valueAt(basis.derivative(column, m), x - kStep)) /
                                      (2 * kStep);
        EXPECT_NEAR(slope, valueAt(basis.derivative(column, m + 1), x), 1e-6 * (1 + std::abs(slope))) << order << column << m;
      }
    }
    std::vector<double> table(static_cast<std::size_t>((kUnknowns + 1) * (order + 1)));
    basis.tabulate(-0.37, 1.7, table.data());
    const std::vector<double> weights{2, -1, 0.5, 3};
    for (int m = 0; m <= order; ++m) {
      double sum = 0;
      for (int column = 0; column <= kUnknowns; ++column) {
        const double value = valueAt(basis.derivative(column, m), -0.37);
        EXPECT_NEAR(table[static_cast<std::size_t>(column * (order + 1) + m)], std::pow(1.7, m) * value, 1e-9 * (1 + std::abs(value)));
        if (column < 4) sum += weights[static_cast<std::size_t>(column)] * value;
      }
      EXPECT_NEAR(valueAt(basis.combine(weights, m), -0.37), sum, 1e-9 * (1 + std::abs(sum)));
    }
  }
}

// Two motions, three local variables that mix them and their derivatives, two residuals that bend.
TranscribedProblem bentProblem() {
  constexpr int kLocals = 3;
  TranscribedProblem problem;
  problem.duration = 1.3;
  problem.order = 2;
  problem.locals = kLocals;
  problem.residuals = 2;
  problem.from = {0.2, -0.4};
  problem.to = {1.1, 0.3};
  problem.local = {{1, 0, 0.1, 0, 0.5, 0, 0, 0, 1}, {0, 0.3, 0, 1, 0, 0.2, 0.7, 0, 0}};
  problem.residual = [](const double* a, double* r, double* ra, double* raa) {
    using S = HyperDual<kLocals>;
    const auto v = [&](int i) { return S::variable(i, a[i]); };
    const std::array<S, 2> both{v(0) * v(1) + 2.0 * v(2) + sin(v(0)), v(1) * v(1) - v(2) * v(0)};
    for (int k = 0; k < 2; ++k) {
      std::array<double, kLocals> gradient{};
      std::array<double, kLocals * kLocals> hessian{};
      both[static_cast<std::size_t>(k)].store(r + k, ra == nullptr ? gradient.data() : ra + k * kLocals,
                                              ra == nullptr ? hessian.data() : raa + k * kLocals * kLocals);
    }
  };
  return problem;
}

TEST(TranscribedCost, IsTheIntegralOfItsResidualsWithItsDerivatives) {
  const TranscribedProblem problem = bentProblem();
  const RestToRestBasis basis(problem.order, 5);
  const TranscribedCost cost(problem, basis);
  Vector c(10);
  for (int i = 0; i < 10; ++i) c(i) = 0.1 * std::sin(1.0 + 2 * i);
  // By many intervals of Simpson's rule over the motions themselves.
  constexpr int kParts = 2000;
  double sum = 0;
  for (int i = 0; i <= kParts; ++i) {
    const double x = 2.0 * i / kParts - 1;
    std::array<double, 3> a{}, r{};
    for (std::size_t motion = 0; motion < 2; ++motion)
      for (int m = 0; m <= 2; ++m) {
        double y = m == 0 ? problem.from[motion] : 0;
        for (int column = 0; column <= 5; ++column) {
          const double weight =
              column == 0 ? problem.to[motion] - problem.from[motion] : c(static_cast<Eigen::Index>(motion) * 5 + column - 1);
          y += weight * std::pow(2 / problem.duration, m) * valueAt(basis.derivative(column, m), x);
        }
        for (std::size_t l = 0; l < 3; ++l) a[l] += problem.local[motion][l * 3 + static_cast<std::size_t>(m)] * y;
      }
    problem.residual(a.data(), r.data(), nullptr, nullptr);
    sum += (r[0] * r[0] + r[1] * r[1]) * problem.duration / kParts / 3 * (i == 0 || i == kParts ? 1 : i % 2 == 1 ? 4 : 2);
  }
  EXPECT_NEAR(cost.evaluate(c) / sum, 1, 1e-6) << "few nodes, and a sine among the residuals";
  Vector gradient, otherGradient;
  Matrix hessian, otherHessian;
  EXPECT_NEAR(cost.expand(c, gradient, hessian) / cost.evaluate(c), 1, 1e-13);
  ASSERT_EQ(gradient.size(), 10);
  const double slopes = worstColumn(
      c, [&](const Vector& at) { return Vector::Constant(1, cost.evaluate(at)); }, [&](Eigen::Index i) { return gradient.segment(i, 1); });
  EXPECT_LT(slopes, 1e-6 * gradient.norm());
  const double bends = worstColumn(
      c,
      [&](const Vector& at) {
        cost.expand(at, otherGradient, otherHessian);
        return otherGradient;
      },
      [&](Eigen::Index i) { return hessian.col(i); });
  EXPECT_LT(bends, 1e-6 * hessian.norm());
  EXPECT_EQ(hessian, Matrix(hessian.transpose()));
}

// Of the third derivative alone the answer is the minimum-jerk law, whose unknowns are nought.
TEST(Transcription, ALinearProblemIsSolvedInOneStep) {
  TranscribedProblem problem;
  problem.duration = 1.5;
  problem.locals = problem.residuals = 1;
  problem.from = {0.1};
  problem.to = {0.4};
  problem.local = {{0, 0, 0, 1}};
  problem.residual = [](const double* a, double* r, double* ra, double* raa) {
    *r = *a;
    if (ra != nullptr) *ra = 1, *raa = 0;
  };
  const TranscribedMotion motion = solveTranscription(problem, 8, {{0.3, -0.2, 0.1}});
  EXPECT_NEAR(motion.cost / (720 * 0.09 / std::pow(1.5, 5)), 1, 1e-12);
  EXPECT_LE(motion.iterations, 2);
  EXPECT_NEAR(motion.condition, 1, 1e-9) << "its unknowns do not see each other";
  ASSERT_EQ(motion.coefficient.size(), 1u);
  ASSERT_EQ(motion.coefficient[0].size(), 9u);
  EXPECT_NEAR(motion.coefficient[0][0], 0.3, 1e-15);
  for (std::size_t k = 1; k < 9; ++k) EXPECT_NEAR(motion.coefficient[0][k], 0, 1e-12);
  for (const double s : {0.0, 0.3, 0.8, 1.0}) {
    const auto [y, v, a, j] = motion.at(0, 1.5 * s);
    EXPECT_NEAR(y, 0.1 + 0.3 * s * s * s * (10 - 15 * s + 6 * s * s), 1e-12);
    EXPECT_NEAR(v, 0.2 * 30 * s * s * (1 - s) * (1 - s), 1e-12);
    EXPECT_NEAR(a, 0.3 / 2.25 * 60 * s * (1 - s) * (1 - 2 * s), 1e-11);
    EXPECT_NEAR(j, 0.3 / 3.375 * 60 * (1 - 6 * s + 6 * s * s), 1e-10);
    for (int m = 0; m < 4; ++m)
      EXPECT_NEAR(valueAt(motion.derivative(0, m), 2 * s - 1), motion.at(0, 1.5 * s)[static_cast<std::size_t>(m)], 1e-11) << m;
  }
  const TranscribedMotion found = solveFromStarts(problem, 0);
  EXPECT_NEAR(found.cost / motion.cost, 1, 1e-12);
  EXPECT_LT(found.uncertainty, 2e-9);
  EXPECT_EQ(found.errorBound, 1e-12) << "rounding, not less";
  EXPECT_EQ(solveFromStarts(problem, 11).coefficient[0].size(), 12u);
  EXPECT_EQ(solveFromStarts(problem, 11).errorBound, 1e-12) << "from half as many unknowns again";
}

TEST(Transcription, TheErrorOfAProfileFallsGeometrically) {
  EXPECT_NEAR(estimateError(1e-4, 1e-2), 1e-4 * 1e-3, 1e-20);
  EXPECT_EQ(estimateError(1e-4, 1e-4), 1e-4);
  EXPECT_EQ(estimateError(1e-4, 0), 1e-4) << "nothing is known of a first raise";
  EXPECT_NEAR(boundError(1e-4, 1e-2), 1e-6, 1e-20);
  EXPECT_EQ(boundError(1e-4, 1e-5), 1e-4);
  EXPECT_EQ(boundError(1e-14, 1e-2), 1e-12);
}

TEST(Transcription, AMotionOfAVelocityHasItsIntegralAndItsSlope) {
  constexpr double T = 1.7;
  // v(x) = 1 + 2 x + 3 x^2 - x^4 over x = 2t/T - 1.
  const auto velocity = [](double x) { return 1 + 2 * x + 3 * x * x - std::pow(x, 4); };
  const auto integral = [](double x) { return x + x * x + x * x * x - std::pow(x, 5) / 5; };
  const MotionSeries series = makeSeriesOfSpeed([&](double t) { return velocity(2 * t / T - 1); }, 6, T);
  for (const double x : {-1.0, -0.4, 0.25, 1.0}) {
    EXPECT_NEAR(valueAt(series.velocity, x), velocity(x), 1e-12);
    EXPECT_NEAR(valueAt(series.position, x), T / 2 * (integral(x) - integral(-1)), 1e-12);
    EXPECT_NEAR(valueAt(series.acceleration, x), 2 / T * (2 + 6 * x - 4 * x * x * x), 1e-8);
  }
}

TEST(Transcription, WhatIsSaidOfAMotionIsWhatIsKnown) {
  TranscribedMotion motion{RestToRestBasis(3, 7), {{1}}, {0}, 1};
  motion.cost = 5;
  motion.condition = 20;
  const auto describe = [&] {
    auto p = makeLegendrePrediction({{0, 1}, {1}, {0}}, {{{0, 1}, {1}, {0}}}, 1);
    describeMotion(motion, *p);
    return p;
  };
  EXPECT_EQ(describe()->cost, 5);
  EXPECT_EQ(describe()->condition, 20);
  EXPECT_EQ(describe()->profileError, std::nullopt);
  EXPECT_TRUE(describe()->warnings.empty());
  EXPECT_EQ(describe()->handJump, 0);
  EXPECT_EQ(describe()->handVelocityJump, 0);
  motion.errorBound = 3e-9;
  motion.uncertainty = 1.9e-9;
  EXPECT_EQ(describe()->profileError, 3e-9);
  EXPECT_TRUE(describe()->warnings.empty());
  motion.uncertainty = 2e-9;
  ASSERT_EQ(describe()->warnings.size(), 1u);
  EXPECT_NE(describe()->warnings[0].find("known to 3e-09 of its peak only: the path bends too sharply for 7 unknowns"), std::string::npos);
}

PathPoint onCircle(double t) {
  constexpr double r = 0.3, w = 2;
  const double s = std::sin(w * t), c = std::cos(w * t);
  return {{r * c, r * s, 0}, {-r * w * s, r * w * c, 0}, {-r * w * w * c, -r * w * w * s, 0}, {r * w * w * w * s, -r * w * w * w * c, 0}};
}

TEST(PathCheck, AMovementWhoseDerivativesBelongTogetherIsSmooth) {
  const PathCheck check = checkPath(1.4, onCircle);
  EXPECT_TRUE(check.smooth);
  EXPECT_NEAR(check.cost, std::pow(0.3 * 8, 2) * 1.4, 1e-12) << "the square of its jerk, which does not change";
  EXPECT_EQ(check.brokenAt, 0);
  const PathCheck nothing;
  EXPECT_TRUE(nothing.smooth);
  EXPECT_EQ(nothing.cost + nothing.brokenAt, 0);
}

// In an interval of 1.4 s / 96; each derivative is broken by itself, at either end of the movement and within.
TEST(PathCheck, TellsWhereADerivativeIsNotTheIntegralOfTheNext) {
  for (int kind = 0; kind < 4; ++kind)
    for (const double place : {0.005, 0.7, 0.931, 1.39}) {
      const auto broken = [&](double t) {
        PathPoint p = onCircle(t);
        Vec3& part = kind == 0 ? p.r : kind == 1 ? p.velocity : kind == 2 ? p.acceleration : p.jerk;
        if (kind < 3 && t > place) part.z += 0.01;
        if (kind == 3 && std::abs(t - place) < 0.004) part.y = std::numeric_limits<double>::quiet_NaN();
        return p;
      };
      const PathCheck check = checkPath(1.4, broken);
      EXPECT_FALSE(check.smooth) << kind;
      EXPECT_NEAR(check.brokenAt, place, 1.4 / 96) << kind;
    }
  const PathCheck atEnd = checkPath(1.4, [](double t) {
    PathPoint p = onCircle(t);
    if (t > 1.4 - 1e-9) p.velocity.x = std::numeric_limits<double>::infinity();
    return p;
  });
  EXPECT_FALSE(atEnd.smooth);
}

}  // namespace
}  // namespace reachlab::predict
