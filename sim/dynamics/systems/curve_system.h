#pragma once
#include "sim/dynamics/systems/curve_places.h"

namespace reachlab::dynamics {

/// Chain, parallel object or point on a curve, Eq. (11) for each mass. Springs act along the chords in space (paper sec. 4). Tangential =
/// false: y = (phi_i, omega_i), phi' = omega, |r_phi|^2 omega' = r_phi.(F/m - r_phiphi omega^2). Tangential = true: y = (phi_i, v_i) with v
/// the speed along the curve. phi' = v/|r_phi|, v' = r_phi.F/(m |r_phi|). This form has neither omega^2 nor 1/M and suits curves that are
/// hard somewhere.
template <int N, bool Tangential>
struct CurveSystem : CurvePlaces<N, N, Tangential>, SpaceSystem<Springs<N>> {
  using Places = CurvePlaces<N, N, Tangential>;
  using Space = SpaceSystem<Springs<N>>;
  using Places::curve, Places::n, Space::springs, typename Space::Hand;
  static constexpr Hooks kHas{.ends = true, .settling = true, .leadRate = Tangential};
  static constexpr int kStates = 2 * N;
  using State = Numbers<kStates>;

  CurveSystem(const ObjectModel& model, const constraints::Constraint& constraint, double typicalSpeed)
      : Places(model, constraint, typicalSpeed, model.count()), Space(model) {}

  /// A vector for each mass.
  struct Vectors {
    constraints::Unfilled<std::array<Vec3, kMassCapacity<N>>> all;
    Vec3& operator[](int i) noexcept { return all.value[i]; }
    const Vec3& operator[](int i) const noexcept { return all.value[i]; }
    void set(int i, const Vec3& v) noexcept { all.value[i].x = v.x, all.value[i].y = v.y, all.value[i].z = v.z; }
  };

  void rate(const Hand& hand, const State& y, State& dy) const noexcept { computeRate(hand, y, dy, -1, nullptr); }
  /// The rate, and |r_phi| [m] of mass `lead` from the same evaluation.
  void rate(const Hand& hand, const State& y, State& dy, int lead, double& speed) const noexcept requires Tangential {
    computeRate(hand, y, dy, lead, &speed);
  }

 private:
  [[gnu::always_inline]] void computeRate(const Hand& hand, const State& y, State& dy, int lead, double* speed) const noexcept {
    // Each point remains where the curve wrote it. The other values are copied component by component.
    constraints::Unfilled<std::array<constraints::CurvePoint, kMassCapacity<N>>> points;
    Vectors r, v, force, tangent;
    std::array<double, kMassCapacity<N>> measure, bend;  // Tangential: 1/|r_phi| or 1/|r_phi|^2, r_phi.r_phiphi
    for (int i = 0; i < n(); ++i) curve.function(curve.program, curve.shape.data(), y[i], points.value[i]);
    for (int i = 0; i < n(); ++i) {
      const constraints::CurvePoint& p = points.value[i];
      const double square = fusedDot(p.rPhi, p.rPhi);
      if constexpr (Tangential) {
        const double length = std::sqrt(square);
        if (speed != nullptr && i == lead) *speed = length;
        measure[i] = 1 / std::fmax(length, 1e-290);  // on a cusp T is undefined and unused
        tangent.set(i, measure[i] * p.rPhi);
      } else {
        measure[i] = 1 / square;
        bend[i] = fusedDot(p.rPhi, p.rPhiPhi);
        tangent.set(i, p.rPhi);
      }
      r.set(i, p.r);
      v.set(i, y[n() + i] * tangent[i]);
    }
    springs.push(hand.position, hand.velocity, r, v, force);
    force[0] += springs.extraForce;
    for (int i = 0; i < n(); ++i) {
      const double w = y[n() + i];
      const double drive = mulAdd(springs.inverseMass[i], fusedDot(tangent[i], force[i]), fusedDot(tangent[i], springs.gravity));
      const double drag = springs.inverseMass[i] * springs.viscosity * w;
      double phiRate, slope;
      if constexpr (Tangential) {
        phiRate = w * measure[i];
        slope = drive - drag;
      } else {
        phiRate = w;
        slope = mulAdd(measure[i], mulAdd(-bend[i], w * w, drive), -drag);
      }
      if constexpr (N == 1) {
        dy.assign(phiRate, slope);
      } else {
        dy[i] = phiRate;
        dy[n() + i] = slope;
      }
    }
  }
};

}  // namespace reachlab::dynamics
