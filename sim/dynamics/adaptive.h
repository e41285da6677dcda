#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/dynamics/hand_segment.h"
#include "sim/dynamics/step_report.h"

namespace reachlab {

/// Dormand and Prince's pair of order 8 with error estimators of order 5 and 3 (Hairer, Norsett, Wanner: Solving Ordinary Differential
/// Equations I, 2nd ed., II.5 and II.10), sub-stepping inside a tick; steps end at the tick, so no dense output is needed.
namespace dop853 {
inline constexpr int kStages = 12;
inline constexpr double kC[kStages] = {0, 0.05260015195876773, 0.0789002279381516, 0.1183503419072274, 0.2816496580927726, 0.3333333333333333,
                                       0.25, 0.3076923076923077, 0.6512820512820513, 0.6, 0.8571428571428571, 1.0};
inline constexpr double kA[kStages][kStages - 1] = {
    {},
    {0.05260015195876773},
    {0.0197250569845379, 0.0591751709536137},
    {0.02958758547680685, 0.0, 0.08876275643042054},
    {0.2413651341592667, 0.0, -0.8845494793282861, 0.924834003261792},
    {0.037037037037037035, 0.0, 0.0, 0.17082860872947386, 0.12546768756682242},
    {0.037109375, 0.0, 0.0, 0.17025221101954405, 0.06021653898045596, -0.017578125},
    {0.03709200011850479, 0.0, 0.0, 0.17038392571223998, 0.10726203044637328, -0.015319437748624402, 0.008273789163814023},
    {0.6241109587160757, 0.0, 0.0, -3.3608926294469414, -0.868219346841726, 27.59209969944671, 20.154067550477894, -43.48988418106996},
    {0.47766253643826434, 0.0, 0.0, -2.4881146199716677, -0.590290826836843, 21.230051448181193, 15.279233632882423, -33.28821096898486,
     -0.020331201708508627},
    {-0.9371424300859873, 0.0, 0.0, 5.186372428844064, 1.0914373489967295, -8.149787010746927, -18.52006565999696, 22.739487099350505,
     2.4936055526796523, -3.0467644718982196},
    {2.273310147516538, 0.0, 0.0, -10.53449546673725, -2.0008720582248625, -17.9589318631188, 27.94888452941996, -2.8589982771350235,
     -8.87285693353063, 12.360567175794303, 0.6433927460157636}};
inline constexpr double kB[kStages] = {0.054293734116568765, 0, 0, 0, 0, 4.450312892752409, 1.8915178993145003, -5.801203960010585,
                                       0.3111643669578199, -0.1521609496625161, 0.20136540080403034, 0.04471061572777259};
inline constexpr double kError3[kStages] = {-0.18980075407240762, 0, 0, 0, 0, 4.450312892752409, 1.8915178993145003, -5.801203960010585,
                                            -0.4226823213237919, -0.1521609496625161, 0.20136540080403034, 0.02265179219836082};
inline constexpr double kError5[kStages] = {0.01312004499419488, 0, 0, 0, 0, -1.2251564463762044, -0.4957589496572502, 1.6643771824549864,
                                            -0.35032884874997366, 0.3341791187130175, 0.08192320648511571, -0.022355307863886294};
}  // namespace dop853

inline constexpr double kDefaultTolerance = 1e-13;  // per sub-step, relative to each number's scale

template <class System>
class Adaptive {
 public:
  using State = typename System::State;
  Adaptive(const System&, double tolerance) : tolerance_(tolerance > 0 ? tolerance : kDefaultTolerance) {}
  void restart() noexcept { last_ = 0; }

  /// The whole tick.
  StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y, State& next, StepReport& report) noexcept {
    return advance(system, hand, dt, 1.0, y, next, report);
  }

  /// The part of the tick from 0 to `fraction` of dt.
  StepStatus advance(const System& system, const HandSegment& hand, double dt, double fraction, const State& y0, State& y,
                     StepReport& report) noexcept {
    using namespace dop853;
    const int n = system.states();
    std::array<State, kStages> k = makeStages(n, std::make_index_sequence<kStages>());
    State at(n), next(n);
    y = y0;
    int rhs = 1;
    system.rate(system.handAt(hand, 0), y, k[0]);
    const double end = fraction * dt;
    double t = 0, h = last_ > 0 ? std::min(1.5 * last_, end) : end;
    report.error = 0;
    bool rejected = false;
    while (t < end) {
      if (t + 1.01 * h >= end) h = end - t;
      const bool lastPart = t + h >= end;
      for (int stage = 1; stage < kStages; ++stage) {
        for (int i = 0; i < n; ++i) {
          double sum = 0;
          for (int j = 0; j < stage; ++j) sum += kA[stage][j] * k[j][i];
          at[i] = y[i] + h * sum;
        }
        system.rate(system.handAt(hand, (t + kC[stage] * h) / dt), at, k[stage]);
      }
      rhs += kStages - 1;
      double fifth = 0, third = 0, check = 0;
      for (int i = 0; i < n; ++i) {
        double sum = 0, e3 = 0, e5 = 0;
        for (int j = 0; j < kStages; ++j) {
          sum += kB[j] * k[j][i];
          e3 += kError3[j] * k[j][i];
          e5 += kError5[j] * k[j][i];
        }
        next[i] = y[i] + h * sum;
        check += next[i] * 0.0;
        const double unit = tolerance_ * (system.scale(i) + std::abs(y[i]));
        fifth += e5 / unit * (e5 / unit);
        third += e3 / unit * (e3 / unit);
      }
      const bool finite = check == 0 && std::isfinite(fifth) && std::isfinite(third);
      const double error = finite ? (fifth > 0 ? h * fifth / std::sqrt((fifth + 0.01 * third) * n) : 0.0) : 1e9;
      const double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-12), -0.125), 0.2, rejected ? 1.0 : 5.0);
      if (error <= 1) {
        report.error += tolerance_ * error;
        t = lastPart ? end : t + h;
        y = next;
        if (!lastPart || last_ == 0 || factor < 1) last_ = h;
        if (lastPart) last_ = std::max(last_, h * std::min(factor, 2.0));
        rejected = false;
        if (!lastPart) {
          system.rate(system.handAt(hand, t / dt), y, k[0]);
          ++rhs;
        }
      } else {
        rejected = true;
        last_ = 0;
      }
      h *= finite ? factor : 0.1;
      if (error > 1 && (rhs + kStages > kMostRhsPerTick || t + h == t)) {
        report.rhs += static_cast<std::uint64_t>(rhs);
        return finite ? StepStatus::Capped : StepStatus::NotFinite;
      }
      if (t < end && rhs + kStages > kMostRhsPerTick) {
        report.rhs += static_cast<std::uint64_t>(rhs);
        return StepStatus::Capped;
      }
    }
    report.rhs += static_cast<std::uint64_t>(rhs);
    return StepStatus::Ok;
  }

 private:
  template <std::size_t... I>
  static std::array<State, sizeof...(I)> makeStages(int n, std::index_sequence<I...>) noexcept {
    return {((void)I, State(n))...};
  }
  double tolerance_;
  double last_ = 0;  // [s] size of the last good sub-step
};

}  // namespace reachlab
