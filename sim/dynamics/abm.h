#pragma once
#include <array>
#include <cmath>

#include "sim/dynamics/adaptive.h"

namespace reachlab {

/// Adams-Bashforth-Moulton, predict-evaluate-correct-evaluate (Hairer, Norsett, Wanner I, III.1): two right-hand sides and one hand sample
/// a tick. Predictor of order 8, corrector of order 9: y = p + dt gamma_8 nabla^8 f(p). The correction estimates the error; where it is
/// too large, and in the first ticks after a start or a break, the tick is done by `Fallback` instead (the adaptive pair), and f at the
/// ticks keeps its place in the history.
namespace adams {
inline constexpr int kHistory = 8;
inline constexpr double kGamma[kHistory + 1] = {1.0, 1.0 / 2, 5.0 / 12, 3.0 / 8, 251.0 / 720, 95.0 / 288, 19087.0 / 60480, 5257.0 / 17280,
                                                1070017.0 / 3628800};
inline constexpr double kCorrectorError = 33953.0 / 3628800;  // of order 8, |gamma*_8|

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
      : fallback_(system, tolerance), limit_((tolerance > 0 ? tolerance : kDefaultTolerance) / 10), slopes_(system.states()) {}
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
    bool good = count_ >= adams::kHistory;
    if (good) {
      const adams::Weights& weights = adams::kWeights[newest_];
      State predicted(n), extrapolated(n);
      for (int i = 0; i < n; ++i) {
        double sum = 0, next8 = 0;
        for (int j = 0; j < adams::kHistory; ++j) {
          sum += weights.predict[j] * slopes_(i, j);
          next8 += weights.extrapolate[j] * slopes_(i, j);
        }
        predicted[i] = y[i] + dt * sum;
        extrapolated[i] = next8;
      }
      system.rate(end, predicted, f);
      double worst = 0;
      for (int i = 0; i < n; ++i) {
        const double difference = dt * (f[i] - extrapolated[i]);
        next[i] = predicted[i] + adams::kGamma[adams::kHistory] * difference;
        const double error = std::abs(difference) - limit_ / adams::kCorrectorError * (system.scale(i) + std::abs(y[i]));
        worst = error > worst || error != error ? error : worst;
      }
      report.rhs += 1;
      report.error = limit_;
      good = worst == 0;
    }
    if (!good) {
      const StepStatus status = fallback_.step(system, hand, dt, y, next, report);
      if (status != StepStatus::Ok) {
        restart();
        return status;
      }
    }
    system.rate(end, next, f);
    report.rhs += 1;
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
  /// f at the last eight ticks, the eight values of one number side by side.
  struct Slopes {
    explicit Slopes(int n) : values(static_cast<std::size_t>(n) * adams::kHistory, 0.0) {}
    double operator()(int i, int slot) const noexcept { return values[i * adams::kHistory + slot]; }
    std::vector<double> values;
  };
  void keep(const State& f, int n) noexcept {
    for (int i = 0; i < n; ++i) slopes_.values[i * adams::kHistory + newest_] = f[i];
  }

  Fallback<System> fallback_;
  double limit_;
  double dt_ = 0;
  int count_ = 0, newest_ = 0;
  Slopes slopes_;
};

template <class System>
using Abm = AbmWith<System, Adaptive>;

}  // namespace reachlab
