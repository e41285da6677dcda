#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

// About the place where the first mass is put up.
HandFunction handFrom(const Plant& plant) {
  const Vec3 begin = observed(plant)[0].r;
  return [begin](double t) {
    return HandSample{begin + Vec3{0.03 * std::sin(7 * t), 0.02 * std::sin(5 * t), 0.01 * std::sin(3 * t)},
                      {0.21 * std::cos(7 * t), 0.1 * std::cos(5 * t), 0.03 * std::cos(3 * t)},
                      true};
  };
}

// A trial begins as if nothing had been before it: neither the method's history nor a stop is left in a plant.
TEST(PutUp, APlantMovesAgainAsANewOneDoes) {
  int plants = 0;
  for (const std::string& name : experiment::shippedNames("experiments"))
    for (const char* method : {"", "rk4", "abm", "adaptive", "stiff"}) {
      SCOPED_TRACE(name + " " + method);
      const experiment::Experiment e = experiment::readExperiment(name);
      if (!e.task) continue;
      Scene fresh, used;
      try {
        fresh = compileScene(e, {method, 1e-3, 0}), used = compileScene(e, {method, 1e-3, 0});
      } catch (const Error&) {  // the method is not for this scene
        continue;
      }
      ++plants;
      used.plant->placeAtRest(e.task->start);
      const HandFunction hand = handFrom(*used.plant);
      (void)run(*used.plant, hand, 0.2);
      for (const Scene* scene : {&fresh, &used}) scene->plant->placeAtRest(e.task->start);
      EXPECT_EQ(used.plant->energy(hand(0)), fresh.plant->energy(hand(0)));
      for (const Scene* scene : {&fresh, &used}) (void)run(*scene->plant, hand, 0.1);
      const std::vector<MassState> a = observed(*fresh.plant, hand(0.1)), b = observed(*used.plant, hand(0.1));
      for (std::size_t m = 0; m < a.size(); ++m) {
        EXPECT_EQ(a[m].r, b[m].r);
        EXPECT_EQ(a[m].v, b[m].v);
      }
    }
  EXPECT_GT(plants, 20);
}

TEST(PutUp, WhatStoppedAPlantIsForgotten) {
  experiment::Experiment e = onCurve(makeExperiment(experiment::ObjectKind::Point, {1}, {}), "phi", "sqrt(phi)", "0");
  e.task.emplace().start = {0.1};
  e.task->target = {0.2};
  const Scene scene = freeScene(e, {0.1}, {-1});
  ASSERT_EQ(run(*scene.plant, noHand, 1), StepStatus::AtEnd);
  EXPECT_LT(scene.plant->lastStepFraction(), 1);
  EXPECT_NE(scene.plant->stopReason(), "");
  scene.plant->placeAtRest(std::array{0.1});
  EXPECT_EQ(scene.plant->lastStepFraction(), 1);
  EXPECT_EQ(scene.plant->stopReason(), "");
}

}  // namespace
}  // namespace reachlab::dynamics
