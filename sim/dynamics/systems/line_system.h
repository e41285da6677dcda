#pragma once
#include "sim/dynamics/exact/linear_space.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

/// A chain or parallel object on a straight line, y = (x_1 … x_N, v_1 … v_N) in metres along it. For the methods that an experimenter may
/// request instead of the exact method.
template <int N>
struct LineSystem {
  static constexpr int kStates = 2 * N;
  static constexpr bool kSecondOrder = true;
  static constexpr Hooks kHas{.ends = true};
  using State = Numbers<kStates>;
  struct Hand {
    double r, v;
  };

  Springs<N> springs;
  LinearSpace space;
  double length;
  Vec3 axis;
  double gravity = 0, extraForce = 0;

  LineSystem(const ObjectModel& model, const LinearSpace& where)
      : springs(model), space(where), length(norm(where.tangent)), axis(where.tangent / length) {
    setExtraForce({});
  }
  int n() const noexcept { return springs.n(); }
  int states() const noexcept { return 2 * n(); }
  void setExtraForce(const Vec3& force) noexcept {
    extraForce = dot(force, axis);
    gravity = dot(springs.gravity, axis);
  }
  void setCoupled(const ObjectModel& model, bool coupled) noexcept { springs.setCoupled(model, coupled); }
  Hand handAt(const HandSegment& hand, double s) const noexcept {
    return {dot(valueAt(hand.position, hand.degree, s) - space.origin, axis), dot(valueAt(hand.velocity, hand.degree, s), axis)};
  }
  Hand handOf(const HandSample& hand) const noexcept { return {dot(hand.position - space.origin, axis), dot(hand.velocity, axis)}; }

  void rate(const Hand& hand, const State& y, State& dy) const noexcept {
    Numbers<N> r(n()), v(n()), force(n());
    for (int i = 0; i < n(); ++i) r[i] = y[i], v[i] = y[n() + i];
    springs.push(hand.r, hand.v, r, v, force);
    force[0] += extraForce;
    for (int i = 0; i < n(); ++i) {
      dy[i] = v[i];
      dy[n() + i] = gravity + springs.inverseMass[i] * (force[i] - springs.viscosity * v[i]);
    }
  }
  double scale(int i) const noexcept { return i < n() ? kTypicalPlace : 1.0; }

  void place(std::span<const double> q, std::span<const double> qRate, State& y) const noexcept {
    for (int i = 0; i < n(); ++i) y[i] = q[0] * length, y[n() + i] = qRate[0] * length;
  }
  void locate(const State& y, std::span<MassState> masses) const noexcept {
    for (std::size_t i = 0; i < masses.size(); ++i) {
      const double x = y[static_cast<int>(i)], v = y[n() + static_cast<int>(i)];
      masses[i].q = {x / length, 0};
      masses[i].qRate = {v / length, 0};
      masses[i].r = space.origin + x * axis;
      masses[i].v = v * axis;
    }
  }
  void accelerate(const State&, const State& dy, std::span<MassState> masses) const noexcept {
    for (std::size_t i = 0; i < masses.size(); ++i) masses[i].a = dy[n() + static_cast<int>(i)] * axis;
  }

  std::string stopReason(StepStatus status, const State&) const { return plainReason(status, "the line has no continuation here"); }
  bool bounded() const noexcept { return !space.domain.periodic && (std::isfinite(space.domain.lo) || std::isfinite(space.domain.hi)); }
  bool bounces() const noexcept { return space.domain.atEnd == constraints::AtEnd::Bounce; }
  bool inside(const State& y) const noexcept {
    for (int i = 0; i < n(); ++i)
      if (!(y[i] >= space.domain.lo * length && y[i] <= space.domain.hi * length)) return false;
    return true;
  }
  void meetEnd(const State& beyond, State& y, bool bounce) const noexcept {
    for (int i = 0; i < n(); ++i) putOnEnd(beyond[i], space.domain.lo * length, space.domain.hi * length, bounce, y[i], y[n() + i]);
  }
};

}  // namespace reachlab::dynamics
