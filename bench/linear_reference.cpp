#include "bench/linear_reference.h"

#include <cmath>

#include "base/fault.h"
#include "bench/visit_system.h"

namespace reachlab::bench {
namespace {

constexpr int kHandTerms = 6;  // the hand is a quintic: itself and five derivatives

struct HandTerms {
  std::array<Quad, kHandTerms> derivative{};  // of the displacement by * mj(t/T), k-th at [k]
};

HandTerms handTerms(const HandLaw& law, const Quad& t) {
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

class Matrix {
 public:
  explicit Matrix(int n) : n_(n), a_(n * n, Quad(0)) {}
  Quad& operator()(int i, int j) { return a_[i * n_ + j]; }
  const Quad& operator()(int i, int j) const { return a_[i * n_ + j]; }
  int size() const { return n_; }
  static Matrix identity(int n) {
    Matrix m(n);
    for (int i = 0; i < n; ++i) m(i, i) = 1;
    return m;
  }

 private:
  int n_;
  std::vector<Quad> a_;
};

Matrix multiply(const Matrix& a, const Matrix& b, const Quad& factor) {
  const int n = a.size();
  Matrix c(n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const Quad f = a(i, k) * factor;
      if (f == 0) continue;
      for (int j = 0; j < n; ++j) c(i, j) += f * b(k, j);
    }
  return c;
}

Matrix exponential(Matrix a) {
  const int n = a.size();
  double norm = 0;
  for (int i = 0; i < n; ++i) {
    double row = 0;
    for (int j = 0; j < n; ++j) row += std::abs(static_cast<double>(a(i, j)));
    norm = std::max(norm, row);
  }
  const int squarings = std::max(0, static_cast<int>(std::ceil(std::log2(norm * 4))));
  const Quad scale = 1 / Quad(std::ldexp(1.0, squarings));
  Matrix sum = Matrix::identity(n), term = sum;
  for (int k = 1; k <= 26; ++k) {  // (1/4)^26 / 26! = 5e-43
    term = multiply(term, a, scale / k);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) sum(i, j) += term(i, j);
  }
  for (int i = 0; i < squarings; ++i) sum = multiply(sum, sum, 1);
  return sum;
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

// exp(A dt) of the state and the hand's derivatives together.
template <class System>
Matrix stateAndHandStep(const System& system, const Quad& dt) {
  constexpr int kStates = 2 * System::kCoordinates, kAll = kStates + kHandTerms;
  const double x0 = system.x0;
  // The columns of A, read off the right-hand side at unit vectors (it is linear, and zero at rest under the hand).
  Matrix a(kAll);
  for (int j = 0; j < kStates + 2; ++j) {
    std::array<Quad, kStates> y{}, dy{};
    Quad r[3] = {x0, 0, 0}, v[3] = {0, 0, 0};
    if (j < kStates) y[j] = 1;
    if (j == kStates) r[0] += 1;
    if (j == kStates + 1) v[0] = 1;
    system.rate(y.data(), r, v, dy.data());
    for (int i = 0; i < kStates; ++i) a(i, j) = dy[i] * dt;
  }
  for (int k = 0; k + 1 < kHandTerms; ++k) a(kStates + k, kStates + k + 1) = dt;
  return exponential(a);
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
