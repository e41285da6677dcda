#include <gtest/gtest.h>

#include "sim/dynamics/hand/hand_path.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/held_segment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

// A hand that comes as samples is a polynomial of any degree up to a cubic. From 128 masses on free modes turn in a form of their own.
TEST(ExactPlant, ModesAndMatrixAgreeForAHandOfEveryDegree) {
  for (const int count : {20, 130}) {
    experiment::Experiment modal = makeChain(count, 0.15, 600), matrix = modal;
    matrix.object.damping.assign(static_cast<std::size_t>(count) - 1, 0.0);
    matrix.object.damping[3] = 1e-9;
    const Scene a = compileScene(modal), b = compileScene(matrix);
    for (const int samples : {1, 2, 3, 4}) {
      HandPath path(samples);
      for (const Scene* scene : {&a, &b}) scene->plant->placeAtRest(std::array{0.0});
      for (int i = 0; i < 500; ++i) {
        path.push(reachAt(i * 1e-3));
        for (const Scene* scene : {&a, &b}) ASSERT_EQ(scene->plant->step(path.segment(), 1e-3), StepStatus::Ok);
      }
      const auto ma = observed(*a.plant), mb = observed(*b.plant);
      for (int i = 0; i < count; ++i) EXPECT_NEAR(ma[i].r.x, mb[i].r.x, 1e-11) << samples << " samples, mass " << i + 1 << " of " << count;
    }
  }
}

TEST(ExactPlant, AnHourOfTheUndampedChainKeepsItsEnergy) {
  const Scene scene = compileScene(makeChain(5, 0.6, 600));
  scene.plant->place(std::array{0.0}, std::array{10.0});
  const HandSample hand{{-0.1, 0, 0}, {}, true};
  const double before = scene.plant->energy(hand);
  const HandSegment held = heldSegment(hand.position);
  for (int i = 0; i < 3600000; ++i) ASSERT_EQ(scene.plant->step(held, 1e-3), StepStatus::Ok);
  EXPECT_NEAR(scene.plant->energy(hand) / before, 1, 1e-9) << "3.6 million roundings of 1e-16";
}

}  // namespace
}  // namespace reachlab::dynamics
