#include "sim/dynamics/object/stability.h"

#include <gtest/gtest.h>

#include "sim/dynamics/compile.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/held_segment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

constexpr double kWithin = 0.01;  // the analysis is asked to be this near to where RK4 really breaks

struct Limit {
  const char* name;
  std::function<experiment::Experiment(double)> experiment;
  double stable, unstable, expected;
};

std::vector<Limit> limits() {
  const auto damped = [](double b, double bh) {
    experiment::Experiment e = makeChain(5, 0.6, 600, {600, bh});
    e.object.damping.assign(4, b);
    return e;
  };
  return {{"k, k_h = 600",
           [](double k) {
             return makeChain(5, 0.6, k, {600, 0});
           },
           1e5, 1e7, 1.327e6},
          {"k = k_h",
           [](double k) {
             return makeChain(5, 0.6, k, {k, 0});
           },
           1e5, 1e7, 1.303e6},
          {"m", [](double m) { return makeChain(5, m, 600); }, 0.6, 1e-5, 0.276e-3},
          {"b, b_h = 0", [=](double b) { return damped(b, 0); }, 1, 1e4, 462},
          {"b = b_h", [=](double b) { return damped(b, b); }, 1, 1e4, 454}};
}

/// Where between its stable and its unstable value RK4 begins to grow, to 1e-9 of the value.
double findLimit(const Limit& limit) {
  double stable = limit.stable, unstable = limit.unstable;
  for (int round = 0; round < 100 && std::abs(unstable - stable) > 1e-9 * std::abs(stable); ++round) {
    const double middle = 0.5 * (stable + unstable);
    (isRk4Stable(computeEigenvalues(makeObjectModel(limit.experiment(middle))), kTick) ? stable : unstable) = middle;
  }
  return stable;
}

/// RK4 itself, on both sides of what the analysis says: the energy of a pushed chain grows on one and not on the other.
double energyGrowth(const experiment::Experiment& e) {
  const ObjectModel model = makeObjectModel(e);
  const LinearSpace space{1, {-0.1, 0, 0}, {0.2 / (2 * std::numbers::pi), 0, 0}, {}};
  const auto plant = makeLinePlant(model, space, {"rk4", 0});
  plant->placeAtRest(std::array{0.0});
  plant->setExtraForce({1, 0, 0});
  const HandSample hand{{-0.1, 0, 0}, {}, true};
  const HandSegment held = heldSegment(hand.position);
  double early = 0;
  for (int i = 0; i < 20000; ++i) {
    if (plant->step(held, kTick) != StepStatus::Ok) return std::numeric_limits<double>::infinity();
    if (i == 1000) early = plant->energy(hand);
  }
  const double growth = plant->energy(hand) / early;
  return std::isfinite(growth) ? growth : std::numeric_limits<double>::infinity();
}

TEST(Stability, Rk4ReallyBreaksWhereTheAnalysisSaysAndWhereItIsKnownTo) {
  for (const Limit& limit : limits()) {
    const double found = findLimit(limit);
    EXPECT_NEAR(found / limit.expected, 1, 0.002) << limit.name << ": known to three or four digits";
    const double outwards = limit.unstable > limit.stable ? 1 + kWithin : 1 - kWithin;
    EXPECT_LT(energyGrowth(limit.experiment(found / outwards)), 3) << limit.name << ": inside the limit";
    EXPECT_GT(energyGrowth(limit.experiment(found * outwards)), 1e3) << limit.name << ": beyond it";
  }
}

// Each is a root of det(lambda^2 M + lambda C + K), here of two unlike masses with every damper there is.
TEST(Stability, EigenvaluesSolveTheCharacteristicEquation) {
  ObjectModel m;
  m.kind = experiment::ObjectKind::Chain;
  m.mass = {0.5, 2};
  m.stiffness = {40}, m.damping = {3};
  m.handStiffness = {100, 7}, m.handDamping = {2, 5};
  m.viscosity = 0.8;
  const auto eigenvalues = computeEigenvalues(m);
  ASSERT_EQ(eigenvalues.size(), 4u);
  std::complex<double> sum = 0;
  for (const auto& l : eigenvalues) {
    const auto a = l * l * 0.5 + l * (2 + 3 + 0.8) + 140.0, b = l * l * 2.0 + l * (5 + 3 + 0.8) + 47.0, c = -3.0 * l - 40.0;
    EXPECT_LT(std::abs(a * b - c * c), 1e-9 * std::abs(a * b) + 1e-8);
    sum += l;
  }
  EXPECT_NEAR(sum.real(), -5.8 / 0.5 - 8.8 / 2, 1e-11) << "all four: their sum is the trace";
}

// Held at p, a body swings across p by k (1/m + p^2/I) and along p by k/m, and turns freely about p.
TEST(Stability, OfABodyThatIsHeldBesideItsCentreTheTurnIsKnown) {
  experiment::Experiment e;
  e.object.kind = experiment::ObjectKind::Body;
  e.object.masses = {0.5};
  e.object.inertia = {{{1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, 1e-3}}};
  e.object.fpOffset = {0.06, 0, 0.08};
  e.coupling = experiment::Coupling{200, 0};
  const double along = std::sqrt(200 / 0.5), across = std::sqrt(200 * (1 / 0.5 + 0.01 / 1e-3));
  std::vector<double> speeds;
  for (const auto& value : computeEigenvalues(makeObjectModel(e))) {
    EXPECT_NEAR(value.real(), 0, 1e-6);
    speeds.push_back(std::abs(value));
  }
  std::sort(speeds.begin(), speeds.end());
  ASSERT_EQ(speeds.size(), 12u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(speeds[i], 0) << i;
  for (std::size_t i = 6; i < 8; ++i) EXPECT_NEAR(speeds[i], along, 1e-9) << i;
  for (std::size_t i = 8; i < 12; ++i) EXPECT_NEAR(speeds[i], across, 1e-9) << i;
}

TEST(Stability, OfAHundredMassesEveryModeIsKnownAndOfMoreTheBound) {
  EXPECT_EQ(computeEigenvalues(makeObjectModel(makeChain(100, 0.6, 600))).size(), 200u);
  EXPECT_EQ(computeEigenvalues(makeObjectModel(makeChain(101, 0.6, 600))).size(), 2u);
  EXPECT_NEAR(std::abs(computeEigenvalues(makeObjectModel(makeChain(101, 0.6, 600)))[0]), std::sqrt(2400 / 0.6), 1e-10);
}

TEST(Stability, AModeMayGrowByARoundingAndNoMore) {
  EXPECT_TRUE(isRk4Stable({{0.8e-9, 0.001}}, 1));
  EXPECT_FALSE(isRk4Stable({{1.2e-9, 0.001}}, 1));
  EXPECT_FALSE(isRk4Stable({{-1, 0}, {0, 1}, {1.2e-9, 0.001}, {0, -1}}, 1)) << "any of them";
  EXPECT_TRUE(isRk4Stable({{-2.7, 0}, {0, 2.8}}, 1));
  EXPECT_TRUE(isRk4Stable({}, 1));
}

TEST(Stability, AmplificationIsTheExponentialsSeriesUpToTheFourthPower) {
  EXPECT_NEAR(rk4Amplification({1, 0}), 1 + 1 + 1 / 2.0 + 1 / 6.0 + 1 / 24.0, 1e-15);
  EXPECT_NEAR(rk4Amplification({0, 2}), std::hypot(1 - 2 + 16 / 24.0, 2 - 8 / 6.0), 1e-15);
}

TEST(Stability, TheLongestStepIsThatOfTheFirstModeToGrow) {
  EXPECT_NEAR(findRk4StepLimit({{0, 5}, {0, -5}}), kRk4ImaginaryLimit / 5, 1e-8);
  EXPECT_NEAR(findRk4StepLimit({{0, 5}, {-10, 0}}), kRk4RealLimit / 10, 1e-8);
  EXPECT_TRUE(std::isinf(findRk4StepLimit({{0, 0}})));
  EXPECT_TRUE(std::isinf(findRk4StepLimit({})));
}

// Twice (w, -w) of 0.3 m 60/(w T)^3 times T/h phase errors (w h)^5/120, where neither is held.
TEST(Stability, TheForetoldErrorIsTheJerksJumpTimesThePhaseErrors) {
  const double w = 20, step = 0.01, length = 0.3, duration = 1.5;
  const double amplitude = length * 60 / (30.0 * 30 * 30), phase = 0.2 * 0.2 * 0.2 * 0.2 * 0.2 / 120 * 150;
  EXPECT_NEAR(predictRk4Error({{0, w}, {0, -w}}, step, length, duration), 2 * amplitude * phase, 1e-18);
  EXPECT_NEAR(predictRk4Error({{0, w}, {0, 0}}, step, length, duration), amplitude * phase, 1e-18) << "what stands still errs by nothing";
  EXPECT_NEAR(predictRk4Error({{0, 1}}, step, length, duration), length * 1e-10 / 120 * 150, 1e-20) << "no more than the way itself";
  EXPECT_NEAR(predictRk4Error({{0, 300}}, step, length, duration), length * 60 / (450.0 * 450 * 450), 1e-18) << "no more than all of it";
}

// A medium alone slows every mass down at one rate, which the bound is exactly: -2.8 a step is beyond RK4's limit on the real axis.
TEST(Stability, OfManyMassesAStrongDamperIsSeenAsWell) {
  experiment::Experiment e = makeChain(101, 0.5, 0, {0, 0});
  e.object.viscosity = 0.5 * 2800;
  const auto eigenvalues = computeEigenvalues(makeObjectModel(e));
  EXPECT_FALSE(isRk4Stable(eigenvalues, kTick));
  EXPECT_TRUE(isRk4Stable(eigenvalues, kTick * 2.78 / 2.8));
  EXPECT_NEAR(findRk4StepLimit(eigenvalues), kRk4RealLimit / 2800, 1e-9 / 2800);
}

TEST(Stability, TheFastestModeIsOfTheObjectOnItsCoupling) {
  EXPECT_NEAR(compileScene(makePoint(1, {0.25, 0})).choice.fastestMode, 0.5, 1e-12);
  EXPECT_NEAR(compileScene(makePoint(4, {900, 0})).choice.fastestMode, 15, 1e-12);
}

}  // namespace
}  // namespace reachlab::dynamics
