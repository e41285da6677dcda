#pragma once
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

/// A point, chain or parallel object in free space, y = (r_1 … r_N, v_1 … v_N). For all methods except the exact method.
template <int N>
struct FreeSystem : SpaceSystem<Springs<N>> {
  using Space = SpaceSystem<Springs<N>>;
  using Space::springs, typename Space::Hand;
  static constexpr int kStates = 6 * N;
  static constexpr bool kSecondOrder = true;
  static constexpr Hooks kHas{};
  using State = Numbers<kStates>;

  using Space::Space;
  int n() const noexcept { return springs.n(); }
  int states() const noexcept { return 6 * n(); }

  void rate(const Hand& hand, const State& y, State& dy) const noexcept {
    std::array<Vec3, kMassCapacity<N>> r, v, force;
    for (int i = 0; i < n(); ++i) {
      r[i] = at3(y, i);
      v[i] = at3(y, n() + i);
    }
    springs.push(hand.position, hand.velocity, r, v, force);
    force[0] += springs.extraForce;
    for (int i = 0; i < n(); ++i) {
      put3(dy, i, v[i]);
      put3(dy, n() + i, springs.inverseMass[i] * (force[i] - springs.viscosity * v[i]) + springs.gravity);
    }
  }
  double scale(int i) const noexcept { return i < 3 * n() ? kTypicalPlace : 1.0; }

  void place(std::span<const double> q, std::span<const double> qRate, State& y) const noexcept {
    for (int i = 0; i < n(); ++i) {
      put3(y, i, {q[0], q[1], q[2]});
      put3(y, n() + i, {qRate[0], qRate[1], qRate[2]});
    }
  }
  void locate(const State& y, std::span<MassState> masses) const noexcept {
    for (std::size_t i = 0; i < masses.size(); ++i) {
      masses[i].r = at3(y, static_cast<int>(i));
      masses[i].v = at3(y, n() + static_cast<int>(i));
    }
  }
  void accelerate(const State&, const State& dy, std::span<MassState> masses) const noexcept {
    for (std::size_t i = 0; i < masses.size(); ++i) masses[i].a = at3(dy, n() + static_cast<int>(i));
  }
  std::string stopReason(StepStatus status, const State&) const { return plainReason(status, "there is no continuation here"); }
};

}  // namespace reachlab::dynamics
