#pragma once
#include <algorithm>
#include <cmath>

#include "sim/dynamics/hand/hand_segment.h"
#include "sim/dynamics/methods/dense_output.h"
#include "sim/dynamics/object/step_report.h"

namespace reachlab::dynamics {

inline constexpr double kDefaultTolerance = 1e-13;  // per sub-step, relative to each number's scale

template <class System>
class Adaptive {
 public:
  using State = typename System::State;
  Adaptive(const System&, double tolerance) : tolerance_(tolerance > 0 ? tolerance : kDefaultTolerance) {}
  void restart() noexcept { last_ = 0; }

  StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y, State& next, StepReport& report) noexcept {
    double reached = 0;
    return advance(system, hand, dt, y, next, reached, report, [](auto&&...) { return false; });
  }

  /// Where a mass meets an end of the constraint within the tick.
  struct Meeting {
    bool met = false;
    double share = 1;  // of dt: the last moment at which every mass is on the constraint, to rounding; as far as it came if not Ok
    State beyond;      // just behind it
  };
  /// The tick up to the first meeting; `y` is the state then, or at the tick's end. The moment is found in the dense output of the
  /// sub-step that crosses, so that a meeting costs four right-hand sides.
  StepStatus stepInside(const System& system, const HandSegment& hand, double dt, const State& y0, State& y, Meeting& meeting,
                        StepReport& report) noexcept {
    State inside = y0;
    double reached = 0;
    const StepStatus status = advance(system, hand, dt, y0, y, reached, report,
                                      [&](const auto& rate, double t, double h, const State& from, const auto& k, const State& to) {
                                        const bool ends = !system.inside(to);
                                        if (!ends && !mayHaveTurned(system, from, to, h)) return false;
                                        const auto dense = dop853::makeDenseOutput<System::kStates>(rate, t, h, from, k, to);
                                        report.rhs += 4;
                                        State at(system.states());
                                        double low = 0, high = 1;
                                        inside = from;
                                        meeting.beyond = to;
                                        if (!ends) {
                                          high = findTurnOutside(system, dense, from, meeting.beyond);
                                          if (high == 0) return false;
                                        }
                                        for (double middle = 0.5 * high; middle > low && middle < high; middle = 0.5 * (low + high)) {
                                          dense.at(middle, at);
                                          const bool good = system.inside(at);
                                          (good ? low : high) = middle;
                                          (good ? inside : meeting.beyond) = at;
                                        }
                                        meeting.met = true;
                                        reached = t + low * h;
                                        return true;
                                      });
    meeting.share = reached / dt;
    if (meeting.met) y = inside;
    return status;
  }

 private:
  static bool mayHaveTurned(const System& system, const State& from, const State& to, double h) noexcept {
    if constexpr (requires { system.turned(from, to, h); }) return system.turned(from, to, h);
    return false;
  }
  /// A share of a sub-step at which a mass is beyond an end, though it is back at the sub-step's end; 0 if there is none.
  template <class Dense>
  static double findTurnOutside(const System& system, const Dense& dense, const State& from, State& beyond) noexcept {
    const int n = system.states();
    State at(n), end(n);
    dense.at(1, end);
    const auto outside = [&](double share) {
      dense.at(share, at);
      if (system.inside(at)) return false;
      beyond = at;
      return true;
    };
    if constexpr (requires { system.pieceOf(0); }) {  // on a curve exactly where the speed changes its sign
      for (int i = n / 2; i < n; ++i) {
        if (!(from[i] * end[i] < 0)) continue;
        double low = 0, high = 1;
        for (int round = 0; round < 50; ++round) {
          const double middle = 0.5 * (low + high);
          dense.at(middle, at);
          (from[i] * at[i] > 0 ? low : high) = middle;
        }
        if (outside(high)) return high;
      }
    } else {
      constexpr int kLooks = 64;
      for (int k = 1; k < kLooks; ++k)
        if (outside(k / double{kLooks})) return k / double{kLooks};
    }
    return 0;
  }

  /// Sub-steps from 0 to dt, until `stops(rate, t, h, y, stages, next)` says of an accepted one that it is the last. `t`: how far they came.
  template <class Stops>
  StepStatus advance(const System& system, const HandSegment& hand, double dt, const State& y0, State& y, double& t, StepReport& report,
                     const Stops& stops) noexcept {
    const int n = system.states();
    auto k = dop853::makeStages<System::kStates>(n);
    State trial(n);
    const auto rate = [&](double time, const State& at, State& slope) { system.rate(system.handAt(hand, time / dt), at, slope); };
    double tolerance = tolerance_;
    if constexpr (requires { system.careful; })
      if (system.careful) tolerance *= kCareful;
    [[maybe_unused]] double steep = 1;  // how many times more than usual a unit of phi moves a mass
    const auto unit = [&](int i, double value) {
      const double whole = tolerance * (system.scale(i) + std::abs(value));
      if constexpr (requires { system.steepness(y); })
        if (i < system.rates()) return std::max(whole / steep, kRounding * std::abs(value));
      return whole;
    };
    y = y0;
    rate(0, y, k[0]);
    int rhs = 1;
    double h = last_ > 0 ? std::min(last_, dt) : dt;
    t = 0;
    double most = 5;  // growth allowed: none right after a rejection
    report.error = 0;
    StepStatus status = StepStatus::Ok;
    bool stopped = false;
    while (t < dt) {
      if constexpr (requires { system.reach(y, k[0]); }) h = std::min(h, system.reach(y, k[0]));
      const bool lastPart = t + 1.01 * h >= dt;
      if (lastPart) h = dt - t;
      if constexpr (requires { system.steepness(y); }) steep = system.steepness(y);
      double error = dop853::attempt<System::kStates>(rate, unit, t, h, y, k, trial);
      rhs += dop853::kStages - 1;
      if constexpr (requires { system.steepness(y); })
        if (const double ahead = system.steepness(trial); error <= 1 && ahead > steep) {
          const double before = unit(0, y[0]);  // towards an end without bound of r_phi an error is what it moves the mass there
          steep = ahead;
          error *= before / unit(0, y[0]);
        }
      const double factor = dop853::growth(error, most);
      most = error <= 1 ? 5 : 1;
      if (error <= 1) {
        report.error += tolerance_ * error;
        if (stops(rate, t, h, y, k, trial)) {
          stopped = true;
          break;
        }
        t = lastPart ? dt : t + h;
        y = trial;
        last_ = lastPart ? std::max(last_, h * factor) : h * factor;
        if (!lastPart) {
          rate(t, y, k[0]);
          ++rhs;
        }
      } else {
        last_ = h * factor;
        status = std::isfinite(error) ? StepStatus::Capped : StepStatus::NotFinite;
        if (t + h * factor == t) break;
      }
      h *= factor;
      if (t < dt && rhs + dop853::kStages > kMaxRhsPerTick) {
        status = status == StepStatus::NotFinite && error > 1 ? status : StepStatus::Capped;
        break;
      }
    }
    report.rhs += static_cast<std::uint64_t>(rhs);
    if (t < dt && !stopped) {
      last_ = 0;
      return status;
    }
    return StepStatus::Ok;
  }

  static constexpr double kCareful = 0.01;
  static constexpr double kRounding = 4.5e-16;  // of phi: less is not to be had
  double tolerance_;
  double last_ = 0;  // [s] size of the last good sub-step
};

}  // namespace reachlab::dynamics
