#pragma once
#include <array>
#include <cmath>

#include "sim/dynamics/adaptive.h"

namespace reachlab {

/// Adams-Bashforth-Moulton, predict-evaluate-correct-evaluate (Hairer, Norsett, Wanner I, III.1): at most two right-hand sides and one
/// hand sample a tick. Predictor of order 8, corrector of order 9: y = p + dt gamma_8 nabla^8 f(p). Where the correction is near
/// rounding, f(p) stands for f(y) and the second right-hand side is spared: PEC, whose smaller range of stability does no harm, since a
/// correction that grows brings PECE back. The correction also estimates the error; where it is too large, and in the first ticks after a start or a break, the tick is done by `Fallback` instead (the adaptive pair), and f at the
/// ticks keeps its place in the history.
namespace adams {
inline constexpr int kHistory = 8;
inline constexpr double kGamma[kHistory + 1] = {1.0, 1.0 / 2, 5.0 / 12, 3.0 / 8, 251.0 / 720, 95.0 / 288, 19087.0 / 60480, 5257.0 / 17280,
                                                1070017.0 / 3628800};
inline constexpr double kCorrectorError = 33953.0 / 3628800;  // of order 8, |gamma*_8|
inline constexpr double kSparedShare = 0.1;                   // of the largest good correction: below, f(p) serves as f(y)

constexpr double binomial(int n, int k) {
  double value = 1;
  for (int i = 0; i < k; ++i) value = value * (n - i) / (i + 1);
  return value;
}
/// Weights by slot of a ring whose newest entry is in slot `newest`.
struct Weights {
  double predict[kHistory], extrapolate[kHistory];
};
constexpr std::array<Weights, kHistory> computeWeights() {
  std::array<Weights, kHistory> all{};
  for (int newest = 0; newest < kHistory; ++newest)
    for (int age = 0; age < kHistory; ++age) {
      double predict = 0;
      for (int j = age; j < kHistory; ++j) predict += kGamma[j] * binomial(j, age);
      const double sign = age % 2 == 0 ? 1 : -1;
      const int slot = (newest - age + kHistory) % kHistory;
      all[newest].predict[slot] = sign * predict;
      all[newest].extrapolate[slot] = sign * binomial(kHistory, age + 1);
    }
  return all;
}
inline constexpr std::array<Weights, kHistory> kWeights = computeWeights();
}  // namespace adams

template <class System, template <class> class Fallback>
class AbmWith {
 public:
  using State = typename System::State;
  AbmWith(const System& system, double tolerance)
      : fallback_(system, tolerance), limit_((tolerance > 0 ? tolerance : kDefaultTolerance) / 10), slopes_(adams::kHistory, State(system.states())) {
    for (State& f : slopes_)
      for (int i = 0; i < system.states(); ++i) f[i] = 0;
  }
  void restart() noexcept {
    count_ = 0;
    fallback_.restart();
  }

  StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y, State& next, StepReport& report) noexcept {
    const int n = system.states();
    if (dt != dt_) count_ = 0;
    dt_ = dt;
    if (count_ == 0) {
      newest_ = 0;
      State f(n);
      system.rate(system.handAt(hand, 0), y, f);
      report.rhs += 1;
      keep(f, n);
      count_ = 1;
    }
    const auto end = system.handAt(hand, 1);
    State f(n);
    bool good = count_ >= adams::kHistory, spared = false;
    if (good) {
      const adams::Weights& weights = adams::kWeights[newest_];
      State predicted(n), extrapolated(n);
      const State* slopes = slopes_.data();
      for (int i = 0; i < n; ++i) {
        predicted[i] = y[i] + dt * weighted(weights.predict, slopes, i);
        extrapolated[i] = weighted(weights.extrapolate, slopes, i);
      }
      system.rate(end, predicted, f);
      double worst = 0, noticeable = 0;
      for (int i = 0; i < n; ++i) {
        const double difference = dt * (f[i] - extrapolated[i]), most = limit_ / adams::kCorrectorError * (system.scale(i) + std::abs(y[i]));
        next[i] = predicted[i] + adams::kGamma[adams::kHistory] * difference;
        const double error = std::abs(difference) - most, excess = std::abs(difference) - adams::kSparedShare * most;
        worst = error > worst || error != error ? error : worst;
        noticeable = excess > noticeable ? excess : noticeable;
      }
      report.rhs += 1;
      report.error = limit_;
      good = worst == 0;
      spared = good && noticeable == 0;
    }
    if (!good) {
      const StepStatus status = fallback_.step(system, hand, dt, y, next, report);
      if (status != StepStatus::Ok) {
        restart();
        return status;
      }
    }
    if (!spared) {
      system.rate(end, next, f);
      report.rhs += 1;
    }
    double check = 0;
    for (int i = 0; i < n; ++i) check += f[i] * 0.0;
    if (check != 0) {
      restart();
      return StepStatus::NotFinite;
    }
    newest_ = (newest_ + 1) % adams::kHistory;
    keep(f, n);
    if (count_ < adams::kHistory) ++count_;
    return StepStatus::Ok;
  }

 private:
  /// In pairs, so that no value waits for a long sum; neighbouring numbers share vector registers.
  static double weighted(const double* w, const State* f, int i) noexcept {
    static_assert(adams::kHistory == 8);
    return ((w[0] * f[0][i] + w[1] * f[1][i]) + (w[2] * f[2][i] + w[3] * f[3][i])) +
           ((w[4] * f[4][i] + w[5] * f[5][i]) + (w[6] * f[6][i] + w[7] * f[7][i]));
  }
  void keep(const State& f, int n) noexcept {
    for (int i = 0; i < n; ++i) slopes_[newest_][i] = f[i];
  }

  Fallback<System> fallback_;
  double limit_;
  double dt_ = 0;
  int count_ = 0, newest_ = 0;
  std::vector<State> slopes_;  // f at the last eight ticks, a ring
};

template <class System>
using Abm = AbmWith<System, Adaptive>;

}  // namespace reachlab
