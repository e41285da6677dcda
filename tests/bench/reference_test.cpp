#include "bench/reference.h"

#include <gtest/gtest.h>

#include "bench/peer_system.h"

namespace reachlab::bench {
namespace {

// Twenty digits of states of order 1 to 10, with two to spare: what a reference promises.
constexpr double kReferenceError = 1e-22;

void expectEqual(const Reference& a, const Reference& b) {
  ASSERT_EQ(a.samples, b.samples);
  for (const auto member : {&Reference::states, &Reference::positions}) {
    const std::vector<Quad>&found = a.*member, &other = b.*member;
    ASSERT_EQ(found.size(), other.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_LT(static_cast<double>(absolute(Quad(found[i] - other[i]))), kReferenceError) << i;
  }
}

TEST(Reference, ModesAndExtrapolationAgreeOnChains) {
  for (const char* name : {"S1", "S1b50"}) {
    SCOPED_TRACE(name);
    const BenchScene scene = benchScene(name);
    expectEqual(modalChainReference(scene), extrapolatedReference(scene));
  }
}

// A lower order with a tighter bound takes steps of about half the length; what both agree on does not depend on the method's settings.
TEST(Reference, ShorterStepsOfALowerOrderChangeNoDigitThatCounts) {
  for (const char* name : {"S2a", "S2b", "S3", "S4", "S5", "S5h", "S6", "S7a", "S7c", "S8"}) {
    SCOPED_TRACE(name);
    const BenchScene scene = benchScene(name);
    expectEqual(extrapolatedReference(scene), extrapolatedReference(scene, {.columns = 11, .tolerance = 1e-30}));
  }
}

TEST(Reference, GeodesicKeepsToTheSphereAndToItsSpeed) {
  const BenchScene scene = benchScene("S7e");
  const Reference reference = computeReference(scene);
  for (int k = 0; k < reference.samples; ++k) {
    const Quad* y = &reference.states[6 * k];
    EXPECT_LT(static_cast<double>(absolute(Quad(squareRoot(dot3(y, y)) - Quad(0.1)))), 1e-17);  // the radius is a double
    EXPECT_NEAR(static_cast<double>(squareRoot(dot3(y + 3, y + 3))), 0.2, 1e-15);               // 2 rad/s, rounded once
  }
}

// sin^2 + cos^2 = 1 and the doubled angle, over every quadrant.
TEST(Quad, SineAndCosineHoldTheirIdentitiesToThirtyTwoDigits) {
  for (int i = -400; i <= 400; ++i) {
    const Quad x = Quad(i) / 37;
    const Quad twice = 2 * x;
    const auto [s, c] = sineCosine(x);
    const auto [s2, c2] = sineCosine(twice);
    EXPECT_LT(static_cast<double>(absolute(Quad(s * s + c * c - 1))), 1e-32);
    EXPECT_LT(static_cast<double>(absolute(Quad(2 * s * c - s2))), 1e-31);
    EXPECT_NEAR(static_cast<double>(c2), std::cos(2.0 * i / 37), 2e-15);
  }
}

// The Taylor segments that drive the plants against the law itself.
TEST(SceneHand, SegmentsFollowTheLawToRounding) {
  for (const BenchScene& scene : benchScenes()) {
    SCOPED_TRACE(scene.name);
    for (int tick = 0; tick < 1350; tick += 7) {
      const double t0 = tick * 1e-3;
      const dynamics::HandSegment segment = makeSegment(scene.hand, t0, 1e-3);
      for (double s : {0.0, 0.5, 1.0}) {
        Vec3 r, v;
        for (int k = segment.degree; k >= 0; --k) r = s * r + segment.position[k], v = s * v + segment.velocity[k];
        const dynamics::HandSample exact = makeSample(scene.hand, t0 + s * 1e-3);
        EXPECT_LT(norm(r - exact.position), 1e-15);  // a few roundings of 0.1 m
        EXPECT_LT(norm(v - exact.velocity), 3e-14);  // of 0.6 m/s, the rate of change of phase rounded at 1e-16 s and 4 phi
      }
    }
  }
}

// Only the axes and terms of the hand that a scene uses are worked out for the other libraries: as if all were.
TEST(PeerSystem, FollowsTheWholeHand) {
  for (const BenchScene& scene : benchScenes()) {
    if (scene.hand.kind == SceneHand::Kind::None) continue;
    const dynamics::HandSegment segment = makeSegments(scene, kTickSeconds)->at(400);
    const dynamics::HandSample hand = dynamics::sampleAt(segment, 0.3);
    const double r[3] = {hand.position.x, hand.position.y, hand.position.z}, v[3] = {hand.velocity.x, hand.velocity.y, hand.velocity.z};
    visitSystem(scene, [&]<class System>(const System& system) {
      constexpr int n = 2 * System::kCoordinates;
      std::vector<double> y(n), expected(n), found(n);
      setInitialState<System>(scene, y.data());
      system.rate(y.data(), r, v, expected.data());
      PeerSystem<System> peer{system, &segment};
      peer.rate(y.data(), found.data(), 0.3 * kTickSeconds);
      for (int i = 0; i < n; ++i) EXPECT_NEAR(found[i], expected[i], 1e-9 * (1 + std::abs(expected[i]))) << scene.name << " " << i;
    });
  }
}

}  // namespace
}  // namespace reachlab::bench
