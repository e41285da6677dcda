// No admissible motion costs less, and the predicted hand takes the object to rest in the program's own simulator.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/math/gauss_legendre.h"
#include "base/math/matrix.h"
#include "sim/dynamics/hand/hand_function.h"
#include "sim/dynamics/object/plant.h"
#include "sim/dynamics/scene.h"
#include "sim/predict/line/flat_output.h"
#include "sim/predict/predict.h"
#include "sim/predict/transcription/rest_to_rest_basis.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

using enum Criterion;

experiment::Experiment damped(experiment::Experiment e) {
  for (double& b : e.object.damping) b = 1.5;
  if (e.coupling) e.coupling->damping = 3;
  return e;
}

// The control as a polynomial of D applied to the flat output, and the conditions per end (docs/theory/criteria.md, "Flat outputs").
struct Control {
  FlatPolynomial polynomial;
  int conditions = 0;
};

Control controlOf(const experiment::Experiment& e, Criterion criterion, double handMass) {
  const LineObject object = makeLineObject(e, handMass, 0);
  const std::vector<FlatPolynomial> node = computeFlatPolynomials(object);
  const int n = object.count();
  FlatPolynomial force;
  const auto add = [&](const FlatPolynomial& row, double factor) {
    force.resize(std::max(force.size(), row.size() + 2), 0);
    for (size_t k = 0; k < row.size(); ++k) force[k + 2] += factor * row[k];
  };
  for (int i = 0; i < n; ++i) add(node[i + 1], object.masses[i]);
  if (handMass > 0) add(node[0], handMass);
  const auto raised = [](FlatPolynomial p, int by) {
    p.insert(p.begin(), by, 0);
    return p;
  };
  const int heavy = handMass > 0 ? 2 : 0;
  switch (criterion) {
    case MinHandJerk: return {raised(node[0], 3), 2 * n + 3};
    case MinHandCrackle: return {raised(node[0], 5), 2 * n + 5};
    case MinCrackle: return {raised({1}, 2 * n + 3), 2 * n + 3};
    case MinHandForce: return {force, 2 * n + heavy};
    case MinHandForceChange: return {raised(force, 1), 2 * n + 1 + heavy};
    default: break;
  }
  for (long double& c : force) c /= object.totalMass();
  return {force, 2 * n + heavy};
}

struct OptimalityCase {
  std::string name;
  experiment::Experiment experiment;
  Criterion criterion;
  double handMass = 0;
};

class Optimality : public testing::TestWithParam<OptimalityCase> {};

// Ritz: motions [s(1-s)]^n times polynomials around the straight one are all admissible. Their least cost must come down to the predicted
// one, and no seeded perturbation may go below it.
TEST_P(Optimality, NoAdmissibleMotionCostsLess) {
  const OptimalityCase& c = GetParam();
  constexpr int kUnknowns = 60;
  constexpr double kReached = 1e-8;  // how near 60 polynomials come to the least cost
  constexpr double kRounding = 1e-9;
  PredictOptions options;
  options.handMass = c.handMass;
  const auto prediction = predict(c.experiment, c.criterion, options);
  const Control control = controlOf(c.experiment, c.criterion, c.handMass);
  const RestToRestBasis basis(control.conditions, kUnknowns);
  const GaussRule rule = makeGaussRule(kUnknowns + control.conditions + 10);
  const double T = prediction->duration;
  const auto rows = static_cast<Eigen::Index>(rule.node.size());
  Eigen::MatrixXd u(rows, kUnknowns + 1);
  for (int column = 0; column <= kUnknowns; ++column)
    for (Eigen::Index i = 0; i < rows; ++i) {
      double sum = 0;
      for (size_t k = 0; k < control.polynomial.size(); ++k)
        if (control.polynomial[k] != 0)
          sum += static_cast<double>(control.polynomial[k]) * std::pow(2 / T, static_cast<double>(k)) *
                 valueAt(basis.derivative(column, static_cast<int>(k)), rule.node[i]);
      u(i, column) = sum * std::sqrt(rule.weight[i] * T / 2);
    }
  const Eigen::VectorXd straight = u.col(0) * 0.2;
  const Eigen::MatrixXd directions = u.rightCols(kUnknowns);
  const Eigen::VectorXd best = directions.colPivHouseholderQr().solve(-straight);
  const double least = (straight + directions * best).squaredNorm();
  EXPECT_NEAR(least / prediction->cost, 1, kReached);

  std::mt19937 random(20240611);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::VectorXd change(kUnknowns);
    for (double& x : change) x = normal(random);
    const Eigen::VectorXd moved = directions * change;
    const double size = std::pow(10.0, -trial % 5) * straight.norm() / moved.norm();
    EXPECT_GT((straight + directions * best + size * moved).squaredNorm(), prediction->cost * (1 - kRounding));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, Optimality,
    testing::Values(OptimalityCase{"jerk", chainModerate(), MinHandJerk}, OptimalityCase{"jerkPair", parallelPair(), MinHandJerk},
                    OptimalityCase{"jerkDamped", damped(makeChain(3, 0.6, 300, 1.35)), MinHandJerk},
                    OptimalityCase{"jerkPairDamped", damped(parallelPair()), MinHandJerk},
                    OptimalityCase{"crackle", dingwell(), MinCrackle}, OptimalityCase{"handCrackle", parallelPair(), MinHandCrackle},
                    OptimalityCase{"force", chainModerate(), MinHandForce}, OptimalityCase{"forceHand", parallelPair(), MinHandForce, 1},
                    OptimalityCase{"forceChange", parallelPair(), MinHandForceChange},
                    OptimalityCase{"forceChangeHand", chainModerate(), MinHandForceChange, 1},
                    OptimalityCase{"forceChangeHandDamped", damped(makeChain(3, 0.6, 300, 1.35)), MinHandForceChange, 1},
                    OptimalityCase{"centre", dingwell(), MinComAcceleration, 1}),
    [](const testing::TestParamInfo<OptimalityCase>& parameter) { return parameter.param.name; });

struct Arrival {
  double position = 0, velocity = 0;  // largest error of any mass [m], [m/s]
};

Arrival simulate(const experiment::Experiment& e, const Prediction& prediction) {
  const dynamics::Scene scene = dynamics::compileScene(e);
  const double start = -0.1, T = prediction.duration;  // [m] of the line's beginning
  scene.plant->placeAtRest(e.task->start);
  const dynamics::HandFunction hand = [&](double t) {
    const PredictedHand h = prediction.handAt(std::min(t, T));
    return dynamics::HandSample{{start + h.position, 0, 0}, {h.velocity, 0, 0}};
  };
  constexpr int kSteps = 1500;
  for (int i = 0; i < kSteps; ++i)
    if (scene.plant->step(dynamics::makeSegment(hand, T * i / kSteps, T / kSteps), T / kSteps) != dynamics::StepStatus::Ok) return {1, 1};
  std::vector<dynamics::MassState> masses(prediction.massCount());
  scene.plant->observe(hand(T), masses);
  Arrival arrival;
  for (const dynamics::MassState& m : masses) {
    arrival.position = std::max(arrival.position, std::abs(m.r.x - 0.1));
    arrival.velocity = std::max(arrival.velocity, std::abs(m.v.x));
  }
  return arrival;
}

// Each family of predictions works it out in a way of its own, as profiles and peaks ask for it alone.
TEST(Prediction, OfTheObjectsVelocityIsThatOfItsLastMass) {
  for (const experiment::Experiment& e : {chainModerate(), parallelPair(), damped(chainModerate())})
    for (const Criterion c : {MinHandJerk, MinCrackle, MinHandForce, MinHandForceChange, MinComAcceleration, MinHandCrackle}) {
      const auto prediction = predict(e, c);
      std::vector<double> x(prediction->massCount()), v(prediction->massCount());
      for (const double part : {0.2, 0.5, 0.9}) {
        prediction->massesAt(part * prediction->duration, x, v);
        EXPECT_NEAR(prediction->objectVelocityAt(part * prediction->duration), v.back(), 1e-12) << nameOf(c) << " at " << part;
      }
    }
}

TEST(Simulator, ArrivesAtRestUnderEveryCriterion) {
  constexpr double kAtRest = 1e-10;  // [m], [m/s]
  experiment::Experiment hardCoupling = damped(chainModerate()), viscous = chainModerate(),
                         viscousTwins = makeParallel({2, 2, 1}, {80, 80, 250}, 2);
  hardCoupling.coupling->damping = 0;
  experiment::Experiment viscousPair = damped(parallelPair());  // whose hand has a speed of its own
  viscous.object.viscosity = viscousTwins.object.viscosity = viscousPair.object.viscosity = 0.7;
  for (const experiment::Experiment& e :
       {dingwell(), chainModerate(), parallelPair(), makeParallel({3, 2, 1}, {50, 250, 100}, 2), damped(chainModerate()),
        damped(parallelPair()), hardCoupling, viscous, viscousTwins, viscousPair})
    for (const double handMass : {0.0, 1.0})
      for (const Criterion c : {MinHandJerk, MinCrackle, MinHandForce, MinHandForceChange, MinComAcceleration, MinHandCrackle}) {
        PredictOptions options;
        options.handMass = handMass;
        const auto prediction = predict(e, c, options);
        const Arrival arrival = simulate(e, *prediction);
        EXPECT_LT(arrival.position, kAtRest) << nameOf(c) << " hand " << handMass << " masses " << prediction->massCount();
        EXPECT_LT(arrival.velocity, kAtRest) << nameOf(c) << " hand " << handMass << " masses " << prediction->massCount();
        const PredictedHand first = prediction->handAt(0), last = prediction->handAt(prediction->duration);
        if (handMass == 0 && c != MinHandJerk && c != MinCrackle && c != MinHandCrackle) continue;
        EXPECT_NEAR(first.position, 0, kAtRest);
        EXPECT_NEAR(first.velocity, 0, kAtRest);
        EXPECT_NEAR(last.position, 0.2, kAtRest);
        EXPECT_NEAR(last.velocity, 0, kAtRest);
      }
}

}  // namespace
}  // namespace reachlab::predict
