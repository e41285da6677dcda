// The predicted hand takes the object to rest in the program's own simulator.
#include <gtest/gtest.h>

#include "sim/predict/predict.h"
#include "tests/predict/arrival.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

using enum Criterion;

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
        const CurveArrival arrival = simulateOn(e, *prediction);
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
