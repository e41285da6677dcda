#include <gtest/gtest.h>

#include <random>

#include "base/math/minimum_jerk.h"
#include "sim/dynamics/systems/batch_system.h"
#include "sim/dynamics/systems/curve_system.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

constexpr double kReordering = 1e-12;  // of the largest rate: another order of the same sums

/// The two forms of the same equations at random states.
template <int Batches, bool Tangential>
void expectSameRates(int n, bool parallel, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto numbers = [&](int count, double scale) {
    std::vector<double> list(static_cast<std::size_t>(count));
    for (double& value : list) value = scale * (0.2 + unit(random));
    return list;
  };
  ObjectModel model;
  model.kind = parallel ? experiment::ObjectKind::Parallel : experiment::ObjectKind::Chain;
  model.mass = numbers(n, 1);
  if (!parallel) model.stiffness = numbers(n - 1, 600), model.damping = numbers(n - 1, 2);
  model.handStiffness = parallel ? numbers(n, 600) : std::vector<double>(static_cast<std::size_t>(n), 0.0);
  model.handDamping = parallel ? numbers(n, 5) : std::vector<double>(static_cast<std::size_t>(n), 0.0);
  model.handStiffness[0] = 600, model.handDamping[0] = 5;
  model.viscosity = 0.7;
  model.gravity = {0.1, -9.81, 0.3};
  const constraints::Constraint c = constraints::makeConstraint({.curve = {"0.1*cos(phi)", "0.06*sin(2*phi)", "0.02*phi"}});

  CurveSystem<0, Tangential> plain(model, c, 0.1);
  BatchSystem<Batches, Tangential> batches(model, c, 0.1);
  typename decltype(plain)::State y(plain.states()), dy(plain.states());
  typename decltype(batches)::State yo(batches.states()), dyo(batches.states());
  for (const bool coupled : {true, false}) {
    plain.springs.setCoupled(model, coupled);
    batches.springs.setCoupled(model, coupled);
    plain.setExtraForce({0.3, 0.1, -0.2});
    batches.setExtraForce({0.3, 0.1, -0.2});
    batches.place(std::array{0.3}, std::array{0.0}, yo);
    for (int i = 0; i < n; ++i) {
      yo[i] = y[i] = 0.3 + 0.2 * i + 0.1 * unit(random);
      yo[batches.rates() + i] = y[plain.rates() + i] = unit(random) - 0.5;
    }
    const HandSample hand{{0.2, 0.1, -0.1}, {0.4, -0.3, 0.2}, true};
    plain.rate(hand, y, dy);
    batches.rate(hand, yo, dyo);
    double largest = 0;
    for (int i = 0; i < 2 * n; ++i) largest = std::max(largest, std::abs(dy[i]));
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(dyo[i], dy[i], kReordering * largest) << n << " masses, place " << i;
      EXPECT_NEAR(dyo[batches.rates() + i], dy[plain.rates() + i], kReordering * largest) << n << " masses, rate " << i;
    }
    for (int i = n; i < batches.rates(); ++i) {
      EXPECT_EQ(dyo[i], 0) << "an empty lane moves";
      EXPECT_EQ(dyo[batches.rates() + i], 0) << "an empty lane is pulled";
    }
  }
}

TEST(BatchSystem, PullsAsMassByMass) {
  for (const bool parallel : {false, true}) {
    for (const int n : {2, 3, 5, 7, 8}) {
      expectSameRates<1, false>(n, parallel, static_cast<unsigned>(n));
      expectSameRates<1, true>(n, parallel, static_cast<unsigned>(n));
    }
    for (const int n : {2, 8, 9, 15, 16, 17, 64}) {
      expectSameRates<0, false>(n, parallel, static_cast<unsigned>(n));
      expectSameRates<0, true>(n, parallel, static_cast<unsigned>(n));
    }
  }
}

TEST(Abm, SparesTheSecondRightHandSideWhereAChainsFastestModeIsAFourteenthOfARadianATick) {
  // sqrt(4 k / m) dt = 0.063 and 0.073 with the coupling: beyond what PEC without the corrected rates bears.
  const experiment::Experiment e = onCurve(makeChain(5, 0.6, 800), "0.1*cos(phi)", "0.06*sin(phi)", "0");
  const auto hand = [](double t) {
    const double s = heldMinimumJerk(t / 1.35).value;
    return HandSample{{0.1 * std::cos(s), 0.06 * std::sin(s), 0}, {}, true};
  };
  const Scene abm = compileScene(e, {"abm", 1e-3, 0}), sure = compileScene(e, {"adaptive", 1e-3, 0});
  for (const Scene* scene : {&abm, &sure}) {
    scene->plant->placeAtRest(std::array{0.0});
    ASSERT_EQ(run(*scene->plant, hand, 3), StepStatus::Ok);
  }
  EXPECT_LT(static_cast<double>(abm.plant->rhsEvaluations()) / 3000, 1.3);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(observed(*abm.plant)[i].q[0], observed(*sure.plant)[i].q[0], 1e-10) << "3000 ticks of the default tolerance";
}

}  // namespace
}  // namespace reachlab::dynamics
