#include "bench/reference.h"

#include <array>
#include <cmath>

#include "bench/extrapolation.h"
#include "bench/peer_system.h"

namespace reachlab::bench {
namespace {

int sampleCount(const BenchScene& scene) { return static_cast<int>(std::lround(scene.duration / kSampleEvery)) + 1; }

template <class System>
Reference integrate(const BenchScene& scene, const System& system, const ReferenceSettings& settings) {
  Reference out;
  out.stateSize = scene.cartesian ? 6 : 2 * System::kCoordinates;
  out.massCount = System::kMasses, out.samples = sampleCount(scene);
  const auto rate = [&](const Quad& t, const Quad* y, Quad* dy) {
    Quad r[3], v[3];
    evaluate(scene.hand, t, r, v);
    system.rate(y, r, v, dy);
  };
  Extrapolation<Quad, decltype(rate)> integrator(rate, 2 * System::kCoordinates, settings.columns, settings.tolerance);
  std::vector<Quad> y(2 * System::kCoordinates);
  setInitialState<System>(scene, y.data());
  for (int k = 0; k < out.samples; ++k) {
    if (k > 0) integrator.advance(Quad(k - 1) / 100, Quad(k) / 100, y);
    appendSample(system, y.data(), out);
  }
  return out;
}

// A free bead on a sphere: r = r0 cos(w t) + v0/w sin(w t) with w = |v0|/R, through the very start that the simulator is given.
Reference greatCircle(const BenchScene& scene, double radius) {
  Reference out;
  out.stateSize = 6, out.massCount = 1, out.samples = sampleCount(scene);
  Quad r0[3], v0[3];
  SphereShape{radius}.placeAndVelocity(Quad(scene.start[0]), Quad(scene.start[1]), Quad(scene.rate[0]), Quad(scene.rate[1]), r0, v0);
  const Quad w = squareRoot(dot3(v0, v0)) / radius;
  for (int k = 0; k < out.samples; ++k) {
    const Quad angle = w * k / 100;
    const auto [s, c] = sineCosine(angle);
    for (int i = 0; i < 3; ++i) out.positions.push_back(r0[i] * c + v0[i] / w * s);
    for (int i = 0; i < 3; ++i) out.states.push_back(r0[i] * c + v0[i] / w * s);
    for (int i = 0; i < 3; ++i) out.states.push_back(v0[i] * c - r0[i] * w * s);
  }
  return out;
}

/// The hand's displacement along x, and its five derivatives by time.
std::array<Quad, 6> handTerms(const SceneHand& law, const Quad& t) {
  const Quad p = t / law.duration;
  std::array<Quad, 6> terms{minimumJerk(p), minimumJerkRate(p), minimumJerkAcceleration(p), 60 - 360 * p + 360 * p * p, 720 * p - 360, 720};
  Quad scale = law.by.x;
  for (Quad& term : terms) {
    term *= scale;
    scale /= law.duration;
  }
  return terms;
}

}  // namespace

Reference computeReference(const BenchScene& scene) {
  if (scene.cartesian && scene.hand.kind == SceneHand::Kind::None) return greatCircle(scene, scene.experiment.constraint.shape.at("R"));
  return scene.experiment.object.masses.size() > 10 ? modalChainReference(scene) : extrapolatedReference(scene);
}

Reference extrapolatedReference(const BenchScene& scene, const ReferenceSettings& settings) {
  return visitSystem(scene, [&](const auto& system) { return integrate(scene, system, settings); });
}

Reference modalChainReference(const BenchScene& scene) {
  const experiment::Object& o = scene.experiment.object;
  const int n = static_cast<int>(o.masses.size());
  const Quad k = o.stiffness[0], m = o.masses[0];
  // pi to 113 bits: the double, and what it lacks.
  const Quad pi = Quad(3.141592653589793) + Quad(1.2246467991473532e-16) + Quad(-2.9947698097183397e-33);
  struct Mode {
    Quad w2, w, gain, cosineAmplitude, sineAmplitude;  // of the mode's coordinate, for a unit shape
    std::vector<Quad> shape;                           // by mass, mass 1 first
  };
  std::vector<Mode> modes(n);
  const std::array<Quad, 6> start = handTerms(scene.hand, 0);
  for (int j = 0; j < n; ++j) {
    Mode& mode = modes[j];
    const Quad angle = (2 * j + 1) * pi / (4 * n + 2);
    const Quad sine = sineCosine(angle).sine;
    mode.w2 = 4 * k / m * sine * sine;
    mode.w = squareRoot(mode.w2);
    Quad norm2 = 0;
    mode.shape.resize(n);
    for (int i = 0; i < n; ++i) {
      const Quad at = (2 * (n - 1 - i) + 1) * angle;  // mass i counted from the free end
      mode.shape[i] = sineCosine(at).cosine;
      norm2 += mode.shape[i] * mode.shape[i];
    }
    mode.gain = k * mode.shape[0] / (m * norm2);  // q'' + w^2 q = gain h(t)
    const auto& h = start;
    const Quad w4 = mode.w2 * mode.w2;
    mode.cosineAmplitude = -mode.gain / mode.w2 * (h[0] - h[2] / mode.w2 + h[4] / w4);
    mode.sineAmplitude = -mode.gain / mode.w2 * (h[1] - h[3] / mode.w2 + h[5] / w4) / mode.w;
  }
  Reference out;
  out.stateSize = 2 * n, out.massCount = n, out.samples = sampleCount(scene);
  std::vector<Quad> y(2 * n);
  for (int s = 0; s < out.samples; ++s) {
    const auto h = handTerms(scene.hand, Quad(s) / 100);
    y.assign(2 * n, Quad(0));
    for (const Mode& mode : modes) {
      const Quad angle = mode.w * s / 100;
      const auto [sine, cosine] = sineCosine(angle);
      const Quad w4 = mode.w2 * mode.w2;
      const Quad q = mode.gain / mode.w2 * (h[0] - h[2] / mode.w2 + h[4] / w4) + mode.cosineAmplitude * cosine + mode.sineAmplitude * sine;
      const Quad qRate =
          mode.gain / mode.w2 * (h[1] - h[3] / mode.w2 + h[5] / w4) + mode.w * (mode.sineAmplitude * cosine - mode.cosineAmplitude * sine);
      for (int i = 0; i < n; ++i) y[i] += q * mode.shape[i], y[n + i] += qRate * mode.shape[i];
    }
    out.states.insert(out.states.end(), y.begin(), y.end());
    for (int i = 0; i < n; ++i) out.positions.insert(out.positions.end(), {scene.hand.from.x + y[i], Quad(0), Quad(0)});
  }
  return out;
}

}  // namespace reachlab::bench
