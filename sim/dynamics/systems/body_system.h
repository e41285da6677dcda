#pragma once
#include "sim/dynamics/systems/surface_rates.h"
#include "sim/dynamics/systems/system.h"
#include "sim/experiment/environment.h"

namespace reachlab::dynamics {

/// A rigid body in free space. The force of the hand acts at the FP, at `fpOffset` from the centre of mass in body axes, and so also turns
/// the body. c_i of Eq. 7 are force and moment. y = (r, v, quaternion w x y z, angular velocity in body axes).
///   m r'' = F + m g - lambda v,   q' = q (0, w)/2,   I w' = R^T ((R offset) x F) - w x I w
struct BodySystem : SpaceSystem<Springs<1>> {
  static constexpr int kStates = 13;
  static constexpr bool kSecondOrder = false;
  static constexpr Hooks kHas{.settling = true};
  using State = Numbers<13>;

  experiment::SquareMatrix<3> inertia{}, inverseInertia{};
  Vec3 fpOffset;

  BodySystem(const ObjectModel& model, const experiment::Object& object);
  static constexpr int states() noexcept { return 13; }

  struct Pose {
    Vec3 r, v, turn;    // turn: angular velocity, body axes
    double w, x, y, z;  // unit quaternion
    /// From body axes to world axes and back.
    Vec3 toWorld(const Vec3& a) const noexcept {
      const Vec3 u{x, y, z}, t = 2.0 * cross(u, a);
      return a + w * t + cross(u, t);
    }
    Vec3 toBody(const Vec3& a) const noexcept {
      const Vec3 u{-x, -y, -z}, t = 2.0 * cross(u, a);
      return a + w * t + cross(u, t);
    }
    /// The quaternion's rates.
    std::array<double, 4> turning() const noexcept {
      const Vec3& o = turn;
      return {0.5 * (-x * o.x - y * o.y - z * o.z), 0.5 * (w * o.x + y * o.z - z * o.y), 0.5 * (w * o.y + z * o.x - x * o.z),
              0.5 * (w * o.z + x * o.y - y * o.x)};
    }
    BodyState state() const noexcept { return {{w, x, y, z}, toWorld(turn)}; }
  };
  static Pose pose(const State& s) noexcept {
    return {{s[0], s[1], s[2]}, {s[3], s[4], s[5]}, {s[10], s[11], s[12]}, s[6], s[7], s[8], s[9]};
  }
  /// Force of the hand at the FP [N].
  Vec3 handForce(const Pose& p, const Hand& hand) const noexcept {
    const Vec3 arm = p.toWorld(fpOffset), speed = p.v + cross(p.toWorld(p.turn), arm);
    return springs.handStiffness[0] * (hand.position - p.r - arm) + springs.handDamping[0] * (hand.velocity - speed);
  }
  void rate(const Hand& hand, const State& s, State& ds) const noexcept {
    const Pose p = pose(s);
    const Vec3 held = handForce(p, hand);
    const Vec3 force = held + springs.extraForce;
    const Vec3 a = springs.inverseMass[0] * (force - springs.viscosity * p.v) + springs.gravity;
    // The extra force acts on mass 1 at its centre. The force of the hand acts at the FP.
    const Vec3 moment = cross(fpOffset, p.toBody(held)) - cross(p.turn, experiment::times(inertia, p.turn));
    const Vec3 spin = experiment::times(inverseInertia, moment);
    const auto [w, x, y, z] = p.turning();
    ds.values = {p.v.x, p.v.y, p.v.z, a.x, a.y, a.z, w, x, y, z, spin.x, spin.y, spin.z};
  }
  double scale(int i) const noexcept { return i < 3 ? kTypicalPlace : 1.0; }
  Settled settle(const State&, State& s) const noexcept {
    normalise(s, 6);
    return Settled::Same;
  }
  /// Gives the quaternion from number `i` on its length 1.
  static void normalise(auto& s, int i) noexcept {
    const double length = 1 / std::sqrt(s[i] * s[i] + s[i + 1] * s[i + 1] + s[i + 2] * s[i + 2] + s[i + 3] * s[i + 3]);
    for (int k = i; k < i + 4; ++k) s[k] *= length;
  }

  void place(std::span<const double> q, std::span<const double> qRate, State& s) const noexcept {
    s.values = {q[0], q[1], q[2], qRate[0], qRate[1], qRate[2], 1, 0, 0, 0, 0, 0, 0};
  }
  void locate(const State& s, std::span<MassState> masses) const noexcept {
    masses[0].r = {s[0], s[1], s[2]};
    masses[0].v = {s[3], s[4], s[5]};
  }
  void accelerate(const State&, const State& ds, std::span<MassState> masses) const noexcept { masses[0].a = {ds[3], ds[4], ds[5]}; }
  std::string stopReason(StepStatus status, const State&) const { return plainReason(status, "there is no continuation here"); }
};

}  // namespace reachlab::dynamics
