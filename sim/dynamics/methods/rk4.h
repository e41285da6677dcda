#pragma once
#include "sim/dynamics/hand/hand_segment.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

/// The method of the paper: classic fourth-order Runge-Kutta, one step per tick.
template <Equations System>
class Rk4 {
 public:
  using State = typename System::State;
  Rk4(const System&, double /*tolerance*/) {}
  void restart() noexcept {}

  [[gnu::flatten]] StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y, State& next,
                                   std::uint64_t& rhs) noexcept {
    const int n = system.states();
    State k1(n), k2(n), k3(n), k4(n), at(n);
    const auto begin = system.handOf(startOf(hand)), middle = system.handAt(hand, 0.5), end = system.handOf(endOf(hand));
    system.rate(begin, y, k1);
    for (int i = 0; i < n; ++i) at[i] = mulAdd(0.5 * dt, k1[i], y[i]);
    system.rate(middle, at, k2);
    for (int i = 0; i < n; ++i) at[i] = mulAdd(0.5 * dt, k2[i], y[i]);
    system.rate(middle, at, k3);
    for (int i = 0; i < n; ++i) at[i] = mulAdd(dt, k3[i], y[i]);
    system.rate(end, at, k4);
    double check = 0;
    for (int i = 0; i < n; ++i) {
      next[i] = mulAdd(dt / 6, mulAdd(2, k2[i] + k3[i], k1[i] + k4[i]), y[i]);
      check = mulAdd(next[i], 0.0, check);
    }
    rhs += 4;
    return check == 0 ? StepStatus::Ok : StepStatus::NotFinite;
  }
};

}  // namespace reachlab::dynamics
