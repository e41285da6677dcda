// The predicted hand takes the object to rest in the program's own simulator.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/dynamics/hand/hand_function.h"
#include "sim/dynamics/object/plant.h"
#include "sim/dynamics/scene.h"
#include "sim/predict/predict.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

using enum Criterion;

struct LineArrival {
  double position = 0, velocity = 0;  // largest error of any mass [m], [m/s]
};

LineArrival simulateOnLine(const experiment::Experiment& e, const Prediction& prediction) {
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
  LineArrival arrival;
  for (const dynamics::MassState& m : masses) {
    arrival.position = std::max(arrival.position, std::abs(m.r.x - 0.1));
    arrival.velocity = std::max(arrival.velocity, std::abs(m.v.x));
  }
  return arrival;
}

TEST(Simulator, ArrivesAtRestUnderEveryCriterion) {
  constexpr double kAtRest = 1e-10;  // [m], [m/s]
  experiment::Experiment hardCoupling = damped(chainModerate(), 1.5, 3), viscous = chainModerate(),
                         viscousTwins = makeParallel({2, 2, 1}, {80, 80, 250}, 2);
  hardCoupling.coupling->damping = 0;
  experiment::Experiment viscousPair = damped(parallelPair(), 1.5, 3);  // the hand's speed differs from the masses'
  viscous.object.viscosity = viscousTwins.object.viscosity = viscousPair.object.viscosity = 0.7;
  for (const experiment::Experiment& e :
       {dingwell(), chainModerate(), parallelPair(), makeParallel({3, 2, 1}, {50, 250, 100}, 2), damped(chainModerate(), 1.5, 3),
        damped(parallelPair(), 1.5, 3), hardCoupling, viscous, viscousTwins, viscousPair})
    for (const double handMass : {0.0, 1.0})
      for (const Criterion c : {MinHandJerk, MinCrackle, MinHandForce, MinHandForceChange, MinComAcceleration, MinHandCrackle}) {
        const auto prediction = predict(e, c, {.handMass = handMass});
        const LineArrival arrival = simulateOnLine(e, *prediction);
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
