#pragma once
#include <algorithm>
#include <cmath>

#include "sim/dynamics/hand/hand_segment.h"
#include "sim/dynamics/methods/dense_output.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

inline constexpr double kDefaultTolerance = 1e-13;  // per sub-step, relative to each number's scale

/// Sub-steps inside a tick by the pair of order 8 (dop853.h), each as long as its estimated error allows.
template <Equations System>
class Adaptive {
 public:
  using State = typename System::State;
  Adaptive(const System&, double tolerance) : tolerance_(tolerance > 0 ? tolerance : kDefaultTolerance) {}
  void restart() noexcept { last_ = 0; }

  /// The meeting of a mass with an end of the constraint within the tick.
  struct Meeting {
    bool met = false;
    double share = 1;  // of dt: the last moment with every mass on the constraint, to rounding; where the step failed, if not Ok
    State beyond;      // just behind it
  };
  /// `rhs` counts right-hand sides. With a `meeting` the tick ends at the first one, and `y` is the state there.
  StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y0, State& y, std::uint64_t& rhs,
                  Meeting* meeting = nullptr) noexcept {
    const int n = system.states();
    auto k = dop853::makeStages<System::kStates>(n);
    State trial(n);
    const auto rate = [&](double time, const State& at, State& slope) { system.rate(system.handAt(hand, time / dt), at, slope); };
    Allowance allowed(system, tolerance_);
    y = y0;
    rate(0, y, k[0]);
    int used = 1, looks = 0;  // right-hand sides, and what looking ahead cost in their unit
    double t = 0, h = last_ > 0 ? std::min(last_, dt) : dt, growth = kGrowth;
    StepStatus status = StepStatus::Ok;
    bool met = false;
    while (t < dt) {
      double sight = dt;  // no sub-step may lead farther, the last one neither
      if constexpr (System::kHas.sight) {
        sight = system.reach(y, k[0], kNearlyLast * h);
        h = std::min(h, sight);
        if constexpr (System::kHas.careful) looks += system.sightCost();
      }
      const bool lastPart = t + kNearlyLast * h >= dt && dt - t <= sight;
      if (lastPart) h = dt - t;
      allowed.lookAt(y);
      double error = dop853::attempt<System::kStates>(rate, allowed, t, h, y, k, trial);
      used += dop853::kStages - 1;
      error = allowed.atEnd(y, trial, error);
      const double factor = dop853::growth(error, growth);
      if (error <= 1) {
        growth = kGrowth;
        if constexpr (System::kHas.ends)
          if (meeting != nullptr && meets(system, rate, h, k, trial, t, y, *meeting, rhs)) {
            met = true;
            break;
          }
        t = lastPart ? dt : t + h;
        y = trial;
        last_ = lastPart ? std::max(last_, h * factor) : h * factor;
        if (!lastPart) {
          rate(t, y, k[0]);
          ++used;
        }
      } else {
        growth = 1;
        last_ = h * factor;
        status = std::isfinite(error) ? StepStatus::Capped : StepStatus::NotFinite;
        if (t + h * factor == t) break;
      }
      h *= factor;
      if (t < dt && used + looks + dop853::kStages > kMaxRhsPerTick) {
        if (!(status == StepStatus::NotFinite && error > 1)) status = StepStatus::Capped;
        break;
      }
    }
    rhs += static_cast<std::uint64_t>(used);
    if (meeting != nullptr) meeting->met = met, meeting->share = t / dt;
    if (t >= dt || met) return StepStatus::Ok;
    last_ = 0;
    return status;
  }

 private:
  static constexpr double kGrowth = 5;          // largest ratio of a sub-step to the one before it; 1 right after a rejection
  static constexpr double kRounding = 4.5e-16;  // of phi, two units in its last place: a smaller error cannot be reached
  static constexpr double kNearlyLast = 1.01;   // of a sub-step: a shorter rest is taken in one sub-step

  /// Whether a mass meets an end in the sub-step of h from y at t to `to`. Then y and t become the last ones with every mass on the
  /// constraint. They are found in the dense output of the sub-step, so that a meeting costs four right-hand sides.
  template <class Rate>
  static bool meets(const System& system, const Rate& rate, double h, const dop853::Stages<System::kStates>& k, const State& to, double& t,
                    State& y, Meeting& meeting, std::uint64_t& rhs) noexcept {
    const bool ends = !system.inside(to);
    if (!ends && !mayHaveTurned(system, y, to, h)) return false;
    const auto dense = dop853::makeDenseOutput<System::kStates>(rate, t, h, y, k, to);
    rhs += 4;
    meeting.beyond = to;
    const double outside = ends ? 1 : findTurnOutside(system, dense, y, meeting.beyond);
    if (outside == 0) return false;
    t += findLastInside(system, dense, outside, y, meeting.beyond) * h;
    return true;
  }
  static bool mayHaveTurned(const System& system, const State& from, const State& to, double h) noexcept {
    if constexpr (System::kHas.branches) return system.turned(from, to, h);
    return false;
  }
  /// A share of a sub-step at which a mass is beyond an end, although it is back at the end of the sub-step. 0 if no mass is.
  template <class Dense>
  static double findTurnOutside(const System& system, const Dense& dense, const State& from, State& beyond) noexcept {
    if constexpr (System::kHas.pieces) return findReversalOutside(system, dense, from, beyond);
    constexpr int kLooks = 64;
    for (int k = 1; k < kLooks; ++k)
      if (isOutside(system, dense, k / double{kLooks}, beyond)) return k / double{kLooks};
    return 0;
  }
  /// On a curve a mass is farthest beyond an end exactly where its speed changes its sign.
  template <class Dense>
  static double findReversalOutside(const System& system, const Dense& dense, const State& from, State& beyond) noexcept {
    constexpr int kHalvings = 50;  // to the rounding of a share
    const int n = system.states();
    State at(n), end(n);
    dense.at(1, end);
    for (int i = n / 2; i < n; ++i) {
      if (!(from[i] * end[i] < 0)) continue;
      double low = 0, high = 1;
      for (int round = 0; round < kHalvings; ++round) {
        const double middle = 0.5 * (low + high);
        dense.at(middle, at);
        (from[i] * at[i] > 0 ? low : high) = middle;
      }
      if (isOutside(system, dense, high, beyond)) return high;
    }
    return 0;
  }
  template <class Dense>
  static bool isOutside(const System& system, const Dense& dense, double share, State& beyond) noexcept {
    State at(system.states());
    dense.at(share, at);
    if (system.inside(at)) return false;
    beyond = at;
    return true;
  }
  /// The last share of a sub-step with every mass on the constraint, and the states before and behind it. Halving finds it between 0 and a
  /// share at which a mass is `outside`.
  template <class Dense>
  static double findLastInside(const System& system, const Dense& dense, double outside, State& inside, State& beyond) noexcept {
    State at(system.states());
    double low = 0, high = outside;
    for (double middle = 0.5 * high; middle > low && middle < high; middle = 0.5 * (low + high)) {
      dense.at(middle, at);
      const bool good = system.inside(at);
      (good ? low : high) = middle;
      (good ? inside : beyond) = at;
    }
    return low;
  }

  /// The error that a sub-step may have in each number.
  class Allowance {
   public:
    Allowance(const System& system, double tolerance) : system_(system), tolerance_(tolerance) {
      if constexpr (System::kHas.careful) tolerance_ *= system.tightening();
    }
    double operator()(int i, double value) const noexcept {
      const double whole = tolerance_ * (system_.scale(i) + std::abs(value));
      if constexpr (System::kHas.pieces)
        if (i < system_.rates()) return std::max(whole / steep_, kRounding * std::abs(value));
      return whole;
    }
    void lookAt(const State& y) noexcept {
      if constexpr (System::kHas.pieces) steep_ = system_.steepness(y);
    }
    /// The error of a sub-step from y, in units of the error that its end allows. Near an end where r_phi has no bound, an error counts by
    /// the distance that it moves the mass.
    double atEnd(const State& y, const State& end, double error) noexcept {
      if constexpr (System::kHas.pieces) {
        const double ahead = system_.steepness(end);
        if (!(error <= 1 && ahead > steep_)) return error;
        const double before = (*this)(0, y[0]);
        steep_ = ahead;
        return error * (before / (*this)(0, y[0]));
      }
      return error;
    }

   private:
    const System& system_;
    double tolerance_;
    double steep_ = 1;  // how many times more than usual a unit of phi moves a mass
  };

  double tolerance_;
  double last_ = 0;  // [s] size of the last good sub-step
};

}  // namespace reachlab::dynamics
