#include "bench/linear_reference.h"

#include <cmath>

#include "base/fault.h"
#include "bench/linear_step.h"
#include "bench/visit_system.h"

namespace reachlab::bench {
namespace {

struct HandTerms {
  std::array<Quad, kHandTerms> derivative{};  // of the displacement by * mj(t/T), k-th at [k]
};

HandTerms handTerms(const SceneHand& law, const Quad& t) {
  const Quad p = t / law.duration;
  const Quad d[kHandTerms] = {
      minimumJerk(p), minimumJerkRate(p), minimumJerkAcceleration(p), 60 - 360 * p + 360 * p * p, 720 * p - 360, 720};
  HandTerms out;
  Quad scale = law.by.x;
  for (int k = 0; k < kHandTerms; ++k) {
    out.derivative[k] = d[k] * scale;
    scale /= law.duration;
  }
  return out;
}

Reference emptyReference(const BenchScene& scene, int coordinates) {
  Reference out;
  out.stateSize = 2 * coordinates, out.massCount = coordinates;
  out.samples = static_cast<int>(std::lround(scene.duration / kSampleEvery)) + 1;
  out.states.reserve(static_cast<std::size_t>(out.samples) * out.stateSize);
  out.positions.reserve(static_cast<std::size_t>(out.samples) * coordinates * 3);
  return out;
}

void append(Reference& out, const std::vector<Quad>& y, double x0) {
  out.states.insert(out.states.end(), y.begin(), y.begin() + out.stateSize);
  for (int i = 0; i < out.massCount; ++i) {
    out.positions.push_back(x0 + y[i]);
    out.positions.insert(out.positions.end(), 2, Quad(0));
  }
}

template <class System>
Reference propagate(const BenchScene& scene, const System& system) {
  constexpr int kStates = 2 * System::kCoordinates, kAll = kStates + kHandTerms;
  const double x0 = scene.hand.from.x;
  const Matrix step = stateAndHandStep(system, Quad(1) / 100);
  Reference out = emptyReference(scene, System::kCoordinates);
  std::vector<Quad> y(kAll, Quad(0)), next(kAll);
  for (int s = 0; s < out.samples; ++s) {
    if (s > 0) {
      const HandTerms hand = handTerms(scene.hand, Quad(s - 1) / 100);
      std::copy(hand.derivative.begin(), hand.derivative.end(), y.begin() + kStates);
      for (int i = 0; i < kAll; ++i) {
        next[i] = 0;
        for (int j = 0; j < kAll; ++j) next[i] += step(i, j) * y[j];
      }
      y = next;
    }
    append(out, y, x0);
  }
  return out;
}

}  // namespace

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
  const HandTerms start = handTerms(scene.hand, 0);
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
    const auto& h = start.derivative;
    const Quad w4 = mode.w2 * mode.w2;
    mode.cosineAmplitude = -mode.gain / mode.w2 * (h[0] - h[2] / mode.w2 + h[4] / w4);
    mode.sineAmplitude = -mode.gain / mode.w2 * (h[1] - h[3] / mode.w2 + h[5] / w4) / mode.w;
  }
  Reference out = emptyReference(scene, n);
  std::vector<Quad> y(2 * n);
  for (int s = 0; s < out.samples; ++s) {
    const auto h = handTerms(scene.hand, Quad(s) / 100).derivative;
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
    append(out, y, scene.hand.from.x);
  }
  return out;
}

Reference exponentialReference(const BenchScene& scene) {
  return visitSystem(scene, [&]<class System>(const System& system) -> Reference {
    if constexpr (requires { system.x0; } && System::kCoordinates <= 10) return propagate(scene, system);
    throw FaultError(Fault{"scene", "is " + scene.name + ", which has no small matrix"});
  });
}

}  // namespace reachlab::bench
