#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "bench/peer_system.h"
#include "constraints/constraint.h"
#include "sim/dynamics/object/forces.h"
#include "tests/refusal.h"

namespace reachlab::bench {
namespace {

Vec3 vec(const double* a) { return {a[0], a[1], a[2]}; }

/// What the masses do by forces and geometry that share nothing with the right-hand sides.
std::vector<double> expectedRates(const BenchScene& scene, const std::vector<double>& y, const dynamics::HandSample& hand,
                                  std::vector<Vec3>& places) {
  const dynamics::ObjectModel model = dynamics::makeObjectModel(scene.experiment);
  const constraints::Constraint c = constraints::makeConstraint(scene.experiment.constraint);
  const bool line = scene.experiment.constraint.name == "line", surface = c.kind == constraints::ConstraintKind::Surface;
  const int masses = model.count(), n = static_cast<int>(y.size()) / 2;
  std::vector<dynamics::MassState> states(static_cast<std::size_t>(masses));
  std::vector<constraints::CurvePoint> on(static_cast<std::size_t>(masses));
  constraints::SurfacePoint p;
  for (int i = 0; i < masses; ++i) {
    if (surface) {
      p = constraints::evaluate(c.surface, y[0], y[1]);
      states[i].r = p.r, states[i].v = y[2] * p.rU + y[3] * p.rV;
      continue;
    }
    on[i] = line ? constraints::CurvePoint{{scene.hand.from.x + y[i], 0, 0}, {1, 0, 0}, {}} : constraints::evaluate(c.curve, y[i]);
    states[i].r = on[i].r, states[i].v = y[n + i] * on[i].rPhi;
  }
  std::vector<double> dy(y.size());
  const dynamics::Surroundings around{hand, scene.hand.kind != SceneHand::Kind::None, {}};
  for (int i = 0; i < masses; ++i) {
    places.push_back(states[i].r);
    const Vec3 a = dynamics::netForce(model, around, states, i) / model.mass[i];
    if (surface) {
      const Vec3 drive = a - (y[2] * y[2] * p.rUu + 2 * y[2] * y[3] * p.rUv + y[3] * y[3] * p.rVv);
      const double e = dot(p.rU, p.rU), f = dot(p.rU, p.rV), g = dot(p.rV, p.rV), det = e * g - f * f;
      dy = {y[2], y[3], (g * dot(p.rU, drive) - f * dot(p.rV, drive)) / det, (e * dot(p.rV, drive) - f * dot(p.rU, drive)) / det};
    } else {
      dy[i] = y[n + i];
      dy[n + i] = dot(on[i].rPhi, a - y[n + i] * y[n + i] * on[i].rPhiPhi) / dot(on[i].rPhi, on[i].rPhi);
    }
  }
  return dy;
}

TEST(Systems, TheHandWrittenRightHandSidesAreThoseOfTheirExperiments) {
  for (BenchScene scene : benchScenes())
    for (const bool damped : {false, true}) {
      experiment::Object& object = scene.experiment.object;
      if (damped && object.kind == experiment::ObjectKind::Chain) object.damping.assign(object.stiffness.size(), 3);
      SCOPED_TRACE(scene.name);
      std::mt19937 random(7);
      std::uniform_real_distribution<double> unit(0.1, 1);
      visitSystem(scene, [&]<class System>(const System& system) {
        constexpr int n = System::kCoordinates;
        std::vector<double> y(2 * n), found(2 * n), r(3 * System::kMasses, 7.0);
        for (double& value : y) value = unit(random);
        const double at[3] = {unit(random), -unit(random), unit(random)}, speed[3] = {unit(random), unit(random), -unit(random)};
        system.rate(y.data(), at, speed, found.data());
        system.positions(y.data(), r.data());
        std::vector<Vec3> places;
        const std::vector<double> expected = expectedRates(scene, y, {vec(at), vec(speed), true}, places);
        for (int i = 0; i < 2 * n; ++i) EXPECT_NEAR(found[i], expected[i], 1e-11 * (1 + std::abs(expected[i]))) << i;
        for (int i = 0; i < System::kMasses; ++i) EXPECT_LT(norm(vec(r.data() + 3 * i) - places[i]), 1e-15) << i;

        std::vector<Quad> wide(y.begin(), y.end()), fine(2 * n);
        const Quad handAt[3] = {at[0], at[1], at[2]}, handSpeed[3] = {speed[0], speed[1], speed[2]};
        system.rate(wide.data(), handAt, handSpeed, fine.data());
        for (int i = 0; i < 2 * n; ++i) EXPECT_NEAR(static_cast<double>(fine[i]), expected[i], 1e-11 * (1 + std::abs(expected[i]))) << i;
      });
    }
}

TEST(Systems, AHandsVelocityIsAskedForOnlyWhereItIsDamped) {
  const auto asks = [](const char* name) {
    return visitSystem(benchScene(name), [](const auto& system) { return system.handVelocity(); });
  };
  for (const char* name : {"S1", "S1b50", "S6", "S7a", "S7d", "S7e"}) EXPECT_FALSE(asks(name)) << name;
  for (const char* name : {"S2a", "S3", "S4", "S5", "S7b", "S7c", "S7f", "S8"}) EXPECT_TRUE(asks(name)) << name;
}

// --- the scenes

TEST(Scenes, AnUnknownOneIsRefusedWithTheNamesThatThereAre) {
  const std::string words = refusalOf([] { (void)benchScene("S9"); });
  for (const char* part : {"is S9", "S1, S1b50, S1b500, S2a", "S7f, S8, constraint-eval"}) EXPECT_TRUE(holds(words, part));
}

// A tick that does nothing: samples at every tenth, evaluations counted by the tick, and where it gave up.
TEST(PeerSystem, AReachIsSampledAndCountedByItsTicks) {
  const BenchScene scene = benchScene("S2a");
  visitSystem(scene, [&]<class System>(const System& system) {
    const std::vector<dynamics::HandSegment> segments(25);
    double y[2] = {0.3, -0.4}, dy[2];
    int ticks = 0;
    const auto go = [&](int until) {
      PeerSystem<System> peer{system};
      Trajectory out;
      ticks = 0;
      runReach(peer, segments, y, &out, [&] {
        y[0] = 0.3 + 0.01 * ticks;
        for (int i = 0; i < (ticks == 17 ? 5 : 2); ++i) peer.rate(y, dy, 0);
        return ++ticks <= until;
      });
      return out;
    };
    const Trajectory all = go(100);
    EXPECT_EQ(ticks, 25);
    EXPECT_EQ(all.failure, "");
    EXPECT_EQ(all.rhsEvaluations, 2u * 24 + 5);
    EXPECT_EQ(all.worstTick, 5u);
    ASSERT_EQ(all.states.size(), 6u) << "at 0, 10 and 20 ms";
    EXPECT_NEAR(all.states[2], 0.3 + 0.09, 1e-15);
    EXPECT_NEAR(all.states[4], 0.3 + 0.19, 1e-15);
    EXPECT_EQ(all.states[5], -0.4);
    ASSERT_EQ(all.positions.size(), 9u);
    EXPECT_NEAR(all.positions[4], 0.1 * std::cos(0.39), 1e-15);
    EXPECT_EQ(go(12).failure, "gave up at 0.012000 s");
  });
}

}  // namespace
}  // namespace reachlab::bench
