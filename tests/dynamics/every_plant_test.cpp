// Laws that hold for whatever is compiled, on scenes of every form and by every method.
#include <gtest/gtest.h>

#include <functional>

#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"
#include "tests/dynamics/held_segment.h"

namespace reachlab::dynamics {
namespace {

using experiment::Experiment;
using experiment::ObjectKind;

struct MovingPlant {
  const char* name;
  Experiment experiment;
  std::vector<double> q, rate;
  Vec3 hand;
  HandFunction drifting() const {
    return [at = hand](double t) { return HandSample{at + t * Vec3{0.3, -0.2, 0.1}, {0.3, -0.2, 0.1}, true}; };
  }
};

Experiment point() { return makePoint(0.7, {300, 0}); }
Experiment chain(int n) {
  Experiment e = makeChain(n, 0.5, 250, {300, 0});
  for (int i = 0; i < n; ++i) e.object.masses[i] = 0.4 + 0.2 * (i % 3);
  for (int i = 0; i + 1 < n; ++i) e.object.stiffness[i] = 200 + 50 * (i % 2);
  return e;
}
Experiment parallel(int n) {
  Experiment e = makeExperiment(ObjectKind::Parallel, std::vector<double>(n, 0.5), std::vector<double>(n, 100));
  for (int i = 0; i < n; ++i) e.object.stiffness[i] = 100 + 40 * (i % 3), e.object.masses[i] = 0.4 + 0.2 * (i % 2);
  return e;
}
Experiment body() {
  Experiment e = makeBody();
  e.coupling = experiment::Coupling{300, 0};
  e.object.fpOffset = {0.06, -0.03, 0.02};
  return e;
}
Experiment flat(Experiment e) { return onCurve(std::move(e), "0.1*cos(phi)", "0.012*sin(phi)", "0.01*cos(phi)"); }
Experiment kinked(Experiment e) { return onCurve(std::move(e), "phi/10", "0.05*abs(phi) + 0.02*sin(phi)", "0.03*abs(phi - 0.5)"); }
Experiment surface(const char* x, const char* y, const char* z) {
  Experiment e = point();
  e.constraint.surface = {x, y, z};
  return e;
}

/// With gravity, so that nothing is in a plane.
std::vector<MovingPlant> movingPlants() {
  std::vector<MovingPlant> all{
      {"line", chain(3), {0.5}, {2}, {0.05, 0.02, 0}},
      {"line, parallel", parallel(3), {0.5}, {2}, {0.05, 0.02, 0}},
      {"free point", free(point()), {0.1, 0.2, -0.1}, {0.3, -0.2, 0.4}, {0.2, 0.1, 0.1}},
      {"free chain", free(chain(3)), {0.1, 0.2, -0.1}, {0.3, -0.2, 0.4}, {0.2, 0.1, 0.1}},
      {"free parallel", free(parallel(2)), {0.1, 0.2, -0.1}, {0.3, -0.2, 0.4}, {0.2, 0.1, 0.1}},
      {"body", body(), {0.1, 0.2, -0.1}, {0.3, -0.2, 0.4}, {0.2, 0.1, 0.1}},
      {"curve, point", onLoop(point()), {0.3}, {4}, {0.05, 0.1, 0.1}},
      {"curve, chain", onLoop(chain(3)), {0.3}, {4}, {0.05, 0.1, 0.1}},
      {"curve, chain of nine", onLoop(chain(9)), {0.3}, {4}, {0.05, 0.1, 0.1}},
      {"curve, parallel", onLoop(parallel(4)), {0.3}, {4}, {0.05, 0.1, 0.1}},
      {"flat, point", flat(point()), {0.3}, {4}, {0.05, 0.1, 0.1}},
      {"flat, chain", flat(chain(3)), {0.3}, {4}, {0.05, 0.1, 0.1}},
      {"flat, chain of ten", flat(chain(10)), {0.3}, {4}, {0.05, 0.1, 0.1}},
      {"flat, parallel", flat(parallel(3)), {0.3}, {4}, {0.05, 0.1, 0.1}},
      {"kinks, point", kinked(point()), {-0.6}, {5}, {0.05, 0.02, 0.1}},
      {"kinks, chain", kinked(chain(3)), {-0.6}, {5}, {0.05, 0.02, 0.1}},
      {"kinks, parallel", kinked(parallel(2)), {-0.6}, {5}, {0.05, 0.02, 0.1}},
      {"ellipsoid", surface("0.1*cos(u)*cos(v)", "0.08*sin(u)*cos(v)", "0.06*sin(v)"), {0.4, 1.2}, {2, 4}, {0.1, 0.1, 0.1}},
      {"sphere", surface("0.1*cos(u)*cos(v)", "0.1*sin(u)*cos(v)", "0.1*sin(v)"), {0.4, 1.2}, {2, 4}, {0.1, 0.1, 0.1}},
      {"saddle", surface("0.1*u", "0.1*v", "0.05*(u^3 - 3*u*v^2)"), {0.4, 0.2}, {2, -3}, {0.05, 0.1, 0.1}},
      {"oblique", surface("0.1*(u + v)", "0.1*v + 0.004*u", "0.03*sin(u - v)"), {0.4, 0.2}, {2, -3}, {0.05, 0.1, 0.1}},
      {"all but parallel", surface("0.1*(u + v)", "0.001*(u - v)", "0.03*sin(u + v)"), {0.4, 0.2}, {12, -8}, {0.05, 0.1, 0.1}},
      {"past a pole",
       surface("(0.1+0.02*cos(2*v))*cos(v)*cos(u)", "(0.1+0.02*cos(2*v))*cos(v)*sin(u)", "(0.1+0.02*cos(2*v))*sin(v)"),
       {0.3, 1.1},
       {0.4, 5},
       {0.05, 0.1, 0.2}},
      {"past a pole of u",
       surface("(0.1+0.02*cos(2*u))*cos(u)*cos(v)", "(0.1+0.02*cos(2*u))*cos(u)*sin(v)", "(0.1+0.02*cos(2*u))*sin(u)"),
       {-1.1, 0.3},
       {-5, 0.4},
       {0.05, 0.1, -0.2}},
      {"crease", surface("0.1*u", "0.1*v", "0.04*abs(u - 0.5) + 0.02*v^3 + 0.02*u*v"), {0.2, 0.1}, {3, 1}, {0.1, 0.1, 0.05}}};
  for (MovingPlant& c : all) c.experiment.object.gravity = {0.5, -1.2, -0.8};
  return all;
}

/// Compiled and set going with its hand at rest; nothing where the method is not for it.
Scene begun(const MovingPlant& c, const char* method, double step) {
  Scene scene;
  try {
    scene = compileScene(c.experiment, {method, step, 0});
  } catch (const Error&) {
    return scene;
  }
  scene.plant->place(c.q, c.rate);
  if (c.experiment.object.kind == ObjectKind::Body) scene.plant->setAngularVelocity({1, -2, 0.5});
  return scene;
}

// Springs, gravity and motion change among each other: what is held by a hand at rest keeps their sum.
TEST(EveryPlant, KeepsItsEnergyWhereNothingTakesIt) {
  for (const MovingPlant& c : movingPlants())
    for (const char* method : {"auto", "abm", "adaptive", "stiff"}) {
      const Scene scene = begun(c, method, 1e-3);
      if (!scene.plant) continue;
      SCOPED_TRACE(std::string(c.name) + ", " + method + ": " + scene.choice.form);
      const HandSample hand{c.hand, {}, true};
      const double before = scene.plant->energy(hand), moving = 0.5 * dot(observed(*scene.plant)[0].v, observed(*scene.plant)[0].v);
      ASSERT_EQ(run(*scene.plant, hand, 0.3), StepStatus::Ok);
      EXPECT_NEAR(scene.plant->energy(hand), before, (std::string(method) == "stiff" ? 1e-6 : 1e-10) * (1 + std::abs(before)));
      EXPECT_GT(std::abs(0.5 * dot(observed(*scene.plant)[0].v, observed(*scene.plant)[0].v) - moving), 1e-4) << "it was moved";
    }
}

// Every damper and a force from outside: by Simpson's rule over ticks of a tenth of a millisecond.
TEST(EveryPlant, LosesWhatItsDampersTakeAndGainsWhatAForceGives) {
  constexpr double kStep = 2e-4;
  for (MovingPlant c : movingPlants()) {
    Experiment& e = c.experiment;
    experiment::Object& o = e.object;
    o.viscosity = 0.8;
    const bool turns = o.kind == ObjectKind::Body, side = o.kind == ObjectKind::Parallel;
    for (std::size_t i = 0; i < o.stiffness.size(); ++i) o.damping.push_back(2 + static_cast<double>(i % 2));
    if (!side && !turns) e.coupling->damping = 3;  // where it holds a body its place moves otherwise than the mass
    const Scene scene = begun(c, "auto", kStep);
    ASSERT_TRUE(scene.plant) << c.name;
    SCOPED_TRACE(c.name);
    const Vec3 extra{0.6, 0.4, -0.5};
    scene.plant->setExtraForce(extra);
    const HandSample hand{c.hand, {}, true};
    const auto power = [&] {
      const std::vector<MassState> m = observed(*scene.plant, hand);
      double sum = dot(extra, m[0].v);
      if (!side && !turns) sum -= e.coupling->damping * dot(m[0].v, m[0].v);
      for (std::size_t i = 0; i < m.size(); ++i) {
        sum -= o.viscosity * dot(m[i].v, m[i].v);
        if (side) sum -= o.damping[i] * dot(m[i].v, m[i].v);
        else if (i + 1 < m.size()) sum -= o.damping[i] * dot(m[i + 1].v - m[i].v, m[i + 1].v - m[i].v);
      }
      return sum;
    };
    const bool bent = std::string(c.name).starts_with("kink") || std::string(c.name) == "crease";  // forces jump there within a tick
    const double before = scene.plant->energy(hand);
    double work = 0;
    for (int pair = 0; pair < 250; ++pair) {
      const double begin = power();
      ASSERT_EQ(scene.plant->step(heldSegment(c.hand), kStep), StepStatus::Ok);
      const double middle = power();
      ASSERT_EQ(scene.plant->step(heldSegment(c.hand), kStep), StepStatus::Ok);
      work += kStep / 3 * (begin + 4 * middle + power());
    }
    EXPECT_NEAR(scene.plant->energy(hand) - before, work, (bent ? 1e-4 : 1e-9) * (1 + std::abs(work)));
    EXPECT_GT(std::abs(work), 1e-3);
  }
}

// By central differences over steps of 20 us, whose own error is their square.
TEST(EveryPlant, VelocitiesAndAccelerationsAreTheRatesOfThePlaces) {
  constexpr double kStep = 2e-5;
  for (MovingPlant c : movingPlants()) {
    c.experiment.object.viscosity = 0.8;
    for (const char* method : {"auto", "adaptive"}) {
      const Scene scene = begun(c, method, kStep);
      if (!scene.plant) continue;
      SCOPED_TRACE(std::string(c.name) + ", " + method);
      const HandFunction hand = c.drifting();
      std::vector<MassState> at[3];
      int tick = 0;
      for (auto& masses : at) {
        for (const int until = tick == 0 ? 1200 : tick + 1; tick < until; ++tick)
          ASSERT_EQ(scene.plant->step(makeSegment(hand, tick * kStep, kStep), kStep), StepStatus::Ok);
        masses = observed(*scene.plant, hand(tick * kStep));
      }
      for (std::size_t i = 0; i < at[1].size(); ++i) {
        const auto slope = [&](auto of) { return (of(at[2][i]) - of(at[0][i])) / (2 * kStep); };
        const double v = norm(at[1][i].v), a = norm(at[1][i].a);
        EXPECT_LT(norm(slope([](const MassState& m) { return m.r; }) - at[1][i].v), 1e-5 * (1 + v)) << "mass " << i + 1;
        EXPECT_LT(norm(slope([](const MassState& m) { return m.v; }) - at[1][i].a), 1e-4 * (1 + a)) << "mass " << i + 1;
        for (const std::size_t k : {0u, 1u})
          EXPECT_NEAR(slope([k](const MassState& m) { return m.q[k]; }), at[1][i].qRate[k], 1e-4 * (1 + std::abs(at[1][i].qRate[k])))
              << "mass " << i + 1;
      }
    }
  }
}

// Whoever is let go feels no hand, and whoever is held again feels it as before.
TEST(EveryPlant, TheCouplingForceIsTheSpringsAndDampersOfTheHand) {
  for (MovingPlant c : movingPlants()) {
    Experiment& e = c.experiment;
    const bool side = e.object.kind == ObjectKind::Parallel;
    if (side) e.object.damping.assign(e.object.stiffness.size(), 3);
    else e.coupling->damping = 3;
    const Scene scene = begun(c, "auto", 1e-3);
    ASSERT_TRUE(scene.plant) << c.name;
    ASSERT_EQ(run(*scene.plant, HandSample{c.hand, {}, true}, 0.02), StepStatus::Ok);
    const HandSample hand{c.hand + Vec3{0.02, -0.01, 0.03}, {0.3, 0.5, -0.2}, true};
    const std::vector<MassState> m = observed(*scene.plant, hand);
    if (e.object.kind != ObjectKind::Body) {
      Vec3 sum;
      for (std::size_t i = 0; i < (side ? m.size() : 1); ++i)
        sum += (side ? e.object.stiffness[i] : 300) * (hand.position - m[i].r) + 3.0 * (hand.velocity - m[i].v);
      EXPECT_LT(norm(scene.plant->couplingForce(hand) - sum), 1e-11) << c.name;
    }
    const Vec3 held = scene.plant->couplingForce(hand);
    const double with = scene.plant->energy(hand);
    scene.plant->setCoupled(false);
    EXPECT_EQ(scene.plant->couplingForce(hand), Vec3{}) << c.name;
    EXPECT_LT(scene.plant->energy(hand), with) << c.name << ": without the hand's spring";
    scene.plant->setCoupled(true);
    EXPECT_LT(norm(scene.plant->couplingForce(hand) - held), 1e-11) << c.name;
  }
}

// Neither the method's history, nor a chart, a branch or what was met on the way is left in it.
TEST(EveryPlant, ThatIsPutUpAgainMovesToTheBitAsANewOneDoes) {
  for (const MovingPlant& c : movingPlants())
    for (const char* method : {"auto", "abm", "adaptive", "stiff"}) {
      const Scene used = begun(c, method, 1e-3), fresh = begun(c, method, 1e-3);
      if (!used.plant) continue;
      const HandFunction hand = c.drifting();
      ASSERT_EQ(run(*used.plant, hand, 0.15), StepStatus::Ok) << c.name << " " << method;
      used.plant->place(c.q, c.rate);
      if (c.experiment.object.kind == ObjectKind::Body) used.plant->setAngularVelocity({1, -2, 0.5});
      const std::uint64_t before = used.plant->rhsEvaluations(), none = fresh.plant->rhsEvaluations();
      for (const Scene* scene : {&used, &fresh}) ASSERT_EQ(run(*scene->plant, hand, 0.04), StepStatus::Ok);
      const auto a = observed(*used.plant, hand(0.04)), b = observed(*fresh.plant, hand(0.04));
      for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].r, b[i].r) << c.name << " " << method << ", mass " << i + 1;
        EXPECT_EQ(a[i].v, b[i].v) << c.name << " " << method << ", mass " << i + 1;
        EXPECT_EQ(a[i].q, b[i].q) << c.name << " " << method << ", mass " << i + 1;
      }
      EXPECT_EQ(used.plant->rhsEvaluations() - before, fresh.plant->rhsEvaluations() - none) << c.name << " " << method;
    }
}

// The same scene by ever shorter ticks of RK4 comes to where the adaptive method is.
TEST(EveryPlant, Rk4ComesToTheSamePlace) {
  for (const MovingPlant& c : movingPlants()) {
    if (std::string(c.name).starts_with("kink") || std::string(c.name) == "crease") continue;  // a fixed step knows no corner's moment
    const HandFunction hand = c.drifting();
    const Scene rk4 = begun(c, "rk4", 2e-4), sure = begun(c, "adaptive", 1e-3);
    ASSERT_TRUE(rk4.plant && sure.plant) << c.name;
    ASSERT_EQ(run(*rk4.plant, hand, 0.1, 2e-4), StepStatus::Ok);
    ASSERT_EQ(run(*sure.plant, hand, 0.1), StepStatus::Ok);
    const auto a = observed(*rk4.plant, hand(0.1)), b = observed(*sure.plant, hand(0.1));
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(norm(a[i].r - b[i].r), 1e-8) << c.name << ", mass " << i + 1;
  }
}

// The masses of a parallel object feel nothing of each other: each moves as a point alone that its own spring holds.
TEST(EveryPlant, AMassOfAParallelObjectMovesAsAPointOnItsOwnSpring) {
  const auto star = [](Experiment e) { return onCurve(std::move(e), "0.1*cos(phi)^3", "0.1*sin(phi)^3", "0"); };
  for (const auto& [name, on] : std::vector<std::pair<const char*, std::function<Experiment(Experiment)>>>{
           {"loop", onLoop}, {"flat", flat}, {"kinked", kinked}, {"star", star}}) {
    const auto together = [&] {
      Experiment e = on(parallel(3));
      e.object.gravity = {0.3, -0.4, 0.2};
      return e;
    }();
    const Scene scene = compileScene(together);
    const HandSample hand{{0.02, 0.05, 0.01}, {}, true};
    scene.plant->place(std::array{0.6}, std::array{3.0});
    for (int tick = 0; tick < 150; ++tick) ASSERT_EQ(scene.plant->step(heldSegment(hand.position), 1e-3), StepStatus::Ok) << name;
    for (std::size_t i = 0; i < 3; ++i) {
      Experiment alone = on(makePoint(together.object.masses[i], {together.object.stiffness[i], 0}));
      alone.object.gravity = together.object.gravity;
      const Scene one = compileScene(alone);
      one.plant->place(std::array{0.6}, std::array{3.0});
      for (int tick = 0; tick < 150; ++tick) ASSERT_EQ(one.plant->step(heldSegment(hand.position), 1e-3), StepStatus::Ok) << name;
      EXPECT_NEAR(observed(*scene.plant)[i].q[0], observed(*one.plant)[0].q[0], 1e-7) << name << " mass " << i + 1;
      EXPECT_NEAR(norm(observed(*scene.plant)[i].v - observed(*one.plant)[0].v), 0, 1e-7) << name << " mass " << i + 1;
    }
  }
}

TEST(EveryPlant, ForgetsWhatStoppedItWhereItIsPutUpAgain) {
  const Scene scene = freeScene(from(onCurve(makePoint(), "phi", "sqrt(phi)", "0"), {0.1}, {0.2}), {0.1}, {-1});
  ASSERT_EQ(run(*scene.plant, noHand, 1), StepStatus::AtEnd);
  EXPECT_LT(scene.plant->lastStepFraction(), 1);
  EXPECT_NE(scene.plant->stopReason(), "");
  scene.plant->placeAtRest(std::array{0.1});
  EXPECT_EQ(scene.plant->lastStepFraction(), 1);
  EXPECT_EQ(scene.plant->stopReason(), "");
}

}  // namespace
}  // namespace reachlab::dynamics
