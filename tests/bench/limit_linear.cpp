#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/fault.h"
#include "base/ticks.h"
#include "bench/extrapolation.h"
#include "bench/linear_step.h"
#include "bench/visit_system.h"
#include "tests/bench/limit_forms.h"
#include "tests/bench/limit_sincos.h"

namespace reachlab::bench {
namespace {

/// Ten states, sixteen columns: y' = P (y, c). The rows are padded to two vectors of eight.
struct ExactForm {
  static constexpr int kStates = 10, kMasses = 5, kHand = 6, kColumns = kStates + kHand, kRhsPerStep = 0;
  V8 column[kColumns][2] = {};
  alignas(64) double y[16] = {};
  double x0 = 0;

  void step(const dynamics::HandSegment& hand) {
    const auto& p = hand.position;
    V8 a0 = column[10][0] * (p[0].x - x0), a1 = column[10][1] * (p[0].x - x0);
    V8 b0 = column[11][0] * p[1].x, b1 = column[11][1] * p[1].x;
    for (int k = 2; k < kHand; k += 2) {
      a0 += column[10 + k][0] * p[k].x, a1 += column[10 + k][1] * p[k].x;
      b0 += column[11 + k][0] * p[k + 1].x, b1 += column[11 + k][1] * p[k + 1].x;
    }
    V8 c0{}, c1{}, d0{}, d1{};
    for (int j = 0; j < kStates; j += 2) {
      c0 += column[j][0] * y[j], c1 += column[j][1] * y[j];
      d0 += column[j + 1][0] * y[j + 1], d1 += column[j + 1][1] * y[j + 1];
    }
    a0 += b0 + (c0 + d0), a1 += b1 + (c1 + d1);
    __builtin_memcpy(y, &a0, sizeof a0);
    __builtin_memcpy(y + 8, &a1, sizeof a1);
  }
  double probe() const { return y[0]; }
  void state(double* out) const {
    for (int i = 0; i < kStates; ++i) out[i] = y[i];
  }
  void positions(double* r) const {
    for (int i = 0; i < kMasses; ++i) r[3 * i] = x0 + y[i], r[3 * i + 1] = r[3 * i + 2] = 0;
  }
};

/// N modes of the chain, each a rotation in (w q, qdot) plus what the hand's six coefficients give it over a step.
template <int N>
struct ModalForm {
  static constexpr int kStates = 2 * N, kMasses = N, kHand = 6, kRhsPerStep = 0, kLanes = (N + 7) / 8;
  struct Block {
    V8 q{}, p{}, cosine{}, sine{};
    V8 gainQ[kHand]{}, gainP[kHand]{};
  };
  std::vector<Block> blocks{kLanes};
  std::vector<double> shape, frequency;  // shape[mass * N + mode], normalised
  double x0 = 0;

  void step(const dynamics::HandSegment& hand) {
    double c[kHand];
    for (int k = 0; k < kHand; ++k) c[k] = hand.position[k].x;
    c[0] -= x0;
    for (Block& b : blocks) {
      V8 q = b.cosine * b.q + b.sine * b.p, p = b.cosine * b.p - b.sine * b.q;
      for (int k = 0; k < kHand; ++k) q += b.gainQ[k] * c[k], p += b.gainP[k] * c[k];
      b.q = q, b.p = p;
    }
  }
  double probe() const { return blocks[0].q[0]; }
  void state(double* out) const {
    for (int i = 0; i < N; ++i) {
      double x = 0, v = 0;
      for (int j = 0; j < N; ++j) {
        x += shape[i * N + j] * (blocks[j / 8].q[j % 8] / frequency[j]);
        v += shape[i * N + j] * blocks[j / 8].p[j % 8];
      }
      out[i] = x, out[N + i] = v;
    }
  }
  void positions(double* r) const {
    std::vector<double> y(kStates);
    state(y.data());
    for (int i = 0; i < N; ++i) r[3 * i] = x0 + y[i], r[3 * i + 1] = r[3 * i + 2] = 0;
  }
};

// Gains of w^2-oscillator q'' + w^2 q = g h over dt for h = s^k, by the series of its response from rest (w dt < 1, sums to rounding).
template <int N>
Contender makeModal(const BenchScene& scene) {
  const double k = scene.experiment.object.stiffness[0], m = scene.experiment.object.masses[0], dt = kTickSeconds;
  ModalForm<N> form;
  form.x0 = scene.hand.from.x;
  form.shape.resize(N * N);
  form.frequency.resize(N);
  for (int j = 0; j < N; ++j) {
    const double angle = (2 * j + 1) * std::numbers::pi / (4 * N + 2);
    const double w = 2 * std::sqrt(k / m) * std::sin(angle), norm = std::sqrt((2 * N + 1) / 4.0);
    form.frequency[j] = w;
    for (int i = 0; i < N; ++i) form.shape[i * N + j] = std::cos((2 * (N - 1 - i) + 1) * angle) / norm;
    const double gain = k / m * form.shape[j];
    auto& b = form.blocks[j / 8];
    b.cosine[j % 8] = std::cos(w * dt), b.sine[j % 8] = std::sin(w * dt);
    double factorial = 1;
    for (int power = 0; power < ModalForm<N>::kHand; ++power) {
      if (power > 0) factorial *= power;
      // Response to s^k: q = gain dt^2 k! sum_i (-1)^i (w dt)^(2i) / (k + 2 + 2i)!, qdot one power less.
      double q = 0, p = 0, term = factorial * gain * dt;
      for (int i = 1; i <= power + 1; ++i) term /= i;
      for (int i = 0; i < 20; ++i) {
        p += term;
        q += term * dt / (power + 2 + 2 * i);
        term *= -(w * dt) * (w * dt) / ((power + 2 + 2 * i) * (power + 3 + 2 * i));
      }
      b.gainQ[power][j % 8] = w * q, b.gainP[power][j % 8] = p;
    }
  }
  return makeLimitContender(scene, form);
}

}  // namespace

/// y(t + dt) = P (y(t), c), rounded once to double, where c are the coefficients of the hand's displacement in powers of s = t/dt [m].
Contender makeExactLimit(const BenchScene& scene) {
  return visitSystem(scene, [&]<class System>(const System& system) -> Contender {
    if constexpr (requires { system.x0; } && 2 * System::kCoordinates == ExactForm::kStates) {
      const Matrix step = stateAndHandStep(system, Quad(kTickSeconds));
      ExactForm form;
      form.x0 = scene.hand.from.x;
      Quad scale = 1;  // k-th derivative = k!/dt^k times the k-th coefficient
      for (int j = 0; j < ExactForm::kColumns; ++j) {
        for (int i = 0; i < ExactForm::kStates; ++i) form.column[j][i / 8][i % 8] = static_cast<double>(step(i, j) * scale);
        if (j >= ExactForm::kStates) scale *= (j - ExactForm::kStates + 1) / Quad(kTickSeconds);
      }
      return makeLimitContender(scene, form);
    }
    throw RefusedError("scene " + scene.name + " has no form here");
  });
}

Contender makeModalLimit(const BenchScene& scene) { return scene.name == "S1b50" ? makeModal<50>(scene) : makeModal<500>(scene); }

}  // namespace reachlab::bench
