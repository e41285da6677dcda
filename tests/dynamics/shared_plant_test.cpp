#include "sim/dynamics/shared_plant.h"

#include <gtest/gtest.h>

#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/held_segment.h"
#include "tests/dynamics/make_experiment.h"
#include "tests/refusal.h"

namespace reachlab::dynamics {
namespace {

using experiment::Experiment;

/// Swings along x from `offset`.
struct SmoothHand {
  double omega = 3;
  Vec3 offset;
  HandSample operator()(double t) const {
    return {offset + Vec3{0.05 * std::sin(omega * t), 0, 0}, {0.05 * omega * std::cos(omega * t), 0, 0}, true};
  }
};

/// One tick of an object that two hands hold.
void stepByBoth(const Scene& scene, const HandFunction& first, const HandFunction& second, int tick) {
  scene.shared->setHand(1, makeSegment(second, tick * 1e-3, 1e-3), second(tick * 1e-3 + 1e-3));
  ASSERT_EQ(scene.plant->step(makeSegment(first, tick * 1e-3, 1e-3), 1e-3), StepStatus::Ok);
}

Experiment withHands(const std::string& name, std::vector<experiment::Hand> hands) {
  Experiment e = experiment::readExperiment(name);
  e.hands = std::move(hands);
  return e;
}

// RK4 at 1 ms and the exact propagator differ by its error, about 1e-9 m here.
TEST(SharedPlant, OneHandOnMassOneMovesAsTheSceneForOneHand) {
  for (const char* name : {"chain-moderate", "ellipse", "free-point", "chain-on-ellipse"}) {
    const Experiment one = experiment::readExperiment(name);
    const Experiment held = withHands(name, {{1, {one.coupling->stiffness}, {one.coupling->damping}, {}}});
    Scene exact = compileScene(one), shared = compileScene(held);
    ASSERT_NE(shared.shared, nullptr) << name;
    SmoothHand hand;
    hand.offset = observed(*exact.plant)[0].r;
    for (Scene* scene : {&exact, &shared}) ASSERT_EQ(run(*scene->plant, hand, 0.5), StepStatus::Ok) << name;
    const HandSample now = hand(0.5);
    const auto a = observed(*exact.plant, now), b = observed(*shared.plant, now);
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_LT(norm(a[i].r - b[i].r), 1e-8) << name << " mass " << i + 1;
      EXPECT_LT(norm(a[i].v - b[i].v), 1e-7) << name << " mass " << i + 1;
      EXPECT_LT(norm(a[i].a - b[i].a), 1e-5) << name << " mass " << i + 1;
    }
    EXPECT_LT(norm(exact.plant->couplingForce(now) - shared.plant->couplingForce(now)), 1e-5) << name;
    EXPECT_NEAR(exact.plant->energy(now), shared.plant->energy(now), 1e-6) << name;
  }
}

TEST(SharedPlant, ABodyHeldAtOnePlaceMovesAsTheSceneForOneHand) {
  const Experiment one = experiment::readExperiment("free-body");
  const Experiment held = withHands("free-body", {{1, {one.coupling->stiffness}, {one.coupling->damping}, one.object.fpOffset}});
  Scene own = compileScene(one), shared = compileScene(held);
  SmoothHand hand;
  hand.offset = observed(*own.plant)[0].r + one.object.fpOffset + Vec3{0, 0.02, 0};
  for (Scene* scene : {&own, &shared}) ASSERT_EQ(run(*scene->plant, hand, 0.5), StepStatus::Ok);
  const BodyState a = own.plant->body(), b = shared.plant->body();
  EXPECT_GT(norm(a.angularVelocity), 0.01) << "it turns";
  EXPECT_LT(norm(a.angularVelocity - b.angularVelocity), 1e-5);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a.orientation[i], b.orientation[i], 1e-7);
  EXPECT_LT(norm(observed(*own.plant)[0].r - observed(*shared.plant)[0].r), 1e-8);
}

// What the hands do is what the object holds and the dampers have taken: here no damper but the hands' own, whose work is the hands'.
// The trapezium rule over a tick errs by up to 4e-5 of it here.
TEST(SharedPlant, WorkOfTheHandsIsTheObjectsEnergy) {
  for (const std::vector<experiment::Hand>& hands : {std::vector<experiment::Hand>{{1, {600}, {0}, {}}, {5, {600}, {0}, {}}},
                                                     {{0, {50, 0, 100, 0, 0}, {1, 0, 0, 0, 0}, {}}, {4, {200}, {5}, {}}}}) {
    Scene scene = compileScene(withHands("chain-moderate", hands));
    SmoothHand left, right;
    left.offset = right.offset = observed(*scene.plant)[0].r;
    right.omega = 7;
    double most = 0;
    for (int tick = 0; tick < 1000; ++tick) {
      stepByBoth(scene, left, right, tick);
      most = std::max(most, scene.shared->objectEnergy());
      EXPECT_NEAR(scene.shared->work(0) + scene.shared->work(1), scene.shared->objectEnergy(), 4e-5);
    }
    EXPECT_GT(most, 0.01) << "something was moved";
  }
}

TEST(SharedPlant, AHandThatLetsGoActsNoMore) {
  Scene scene = compileScene(withHands("chain-moderate", {{1, {600}, {0}, {}}, {5, {600}, {0}, {}}}));
  const Vec3 start = observed(*scene.plant)[0].r;
  const HandSegment away = heldSegment(start + Vec3{0.1, 0, 0}), rest = heldSegment(start);
  const HandSample there = endOf(away);
  scene.shared->setHand(1, away, there, 0);
  ASSERT_EQ(scene.plant->step(rest, 1e-3), StepStatus::Ok);
  EXPECT_EQ(scene.shared->couplingForceOf(1), (Vec3{}));
  EXPECT_EQ(observed(*scene.plant, {start, {}, true})[4].v, (Vec3{}));
  scene.shared->setHand(1, away, there, 0.5);
  EXPECT_NEAR(scene.shared->couplingForceOf(1).x, 0.5 * 600 * 0.1, 1e-9);
}

TEST(SharedPlant, RefusesWhatItCannotDo) {
  const auto hands = [](int mass) { return std::vector<experiment::Hand>{{1, {600}, {0}, {}}, {mass, {600}, {0}, {}}}; };
  Experiment chain = withHands("chain-moderate", hands(5));
  chain.method = "exact";
  EXPECT_THROW(compileScene(chain), RefusedError);
  EXPECT_THROW(compileScene(withHands("torus", hands(1))), Error);
  EXPECT_FALSE(experiment::check(withHands("torus", hands(1))).faults.empty());
  EXPECT_FALSE(experiment::check(withHands("chain-moderate", hands(6))).faults.empty());
}

// RK4 in phi divides by |r_phi|: where that vanishes it was wrong without a word.
TEST(SharedPlant, CurvesWithCuspsAreRefusedWithTheirPlace) {
  const auto sayOf = [](const Experiment& e) { return refusalOf([&] { (void)compileScene(e); }); };
  const std::vector<experiment::Hand> two{{1, {600}, {5}, {}}, {1, {600}, {5}, {}}};
  Experiment astroid = withHands("cycloid", two);
  astroid.constraint.name.clear();
  astroid.constraint.curve = {"0.1*cos(phi)^3", "0.1*sin(phi)^3", "0"};
  astroid.task->start = {0.3}, astroid.task->target = {2.5};
  const std::string cusp = sayOf(astroid);
  EXPECT_TRUE(holds(cusp, "cusp at phi = "));
  EXPECT_TRUE(holds(cusp, "use one hand"));
  const std::string atItsEnds = sayOf(withHands("cycloid", two));
  EXPECT_TRUE(holds(atItsEnds, "|r_phi| falls to"));
  EXPECT_EQ(sayOf(withHands("ellipse", two)), "");
  EXPECT_EQ(sayOf(withHands("trefoil", two)), "");
}

}  // namespace
}  // namespace reachlab::dynamics
