#pragma once
#include "sim/dynamics/system.h"

namespace reachlab {

/// Chain, parallel object or point on a curve; springs act along the chords in space (paper sec. 4), Eq. (11) for each mass.
/// Tangential = false: y = (phi_i, omega_i), phi' = omega, |r_phi|^2 omega' = r_phi.(F/m - r_phiphi omega^2).
/// Tangential = true:  y = (phi_i, v_i), v the speed along the curve, phi' = v/|r_phi|, v' = r_phi.F/(m |r_phi|): neither omega^2 nor
/// 1/M, for curves that are hard somewhere.
template <int N, bool Parallel, bool Tangential>
struct CurveSystem {
  static constexpr int kStates = 2 * N;
  static constexpr bool kEnds = true;
  static constexpr const char* kNoContinuation = "the mass rests on a cusp of the curve: which way it would leave is not determined";
  using State = Numbers<kStates>;
  using Hand = HandSample;

  Springs<N, Parallel> springs;
  Curve curve;
  Domain domain;
  double speedScale = 1;  // [m] typical |r_phi|

  CurveSystem(const ObjectModel& model, const Constraint& constraint)
      : springs(model), curve(constraint.curve), domain(constraint.domain[0]) {}
  double speedAt(double phi) const noexcept { return norm(evaluate(curve, phi).rPhi); }
  int n() const noexcept { return springs.n(); }
  int states() const noexcept { return 2 * n(); }
  void setExtraForce(const Vec3& force) noexcept { springs.extraForce = force; }
  Hand handAt(const HandSegment& hand, double s) const noexcept { return sampleAt(hand, s); }
  Hand handOf(const HandSample& hand) const noexcept { return hand; }

  /// A vector for each mass.
  struct Vectors {
    Unfilled<std::array<Vec3, kMostMasses<N>>> all;
    Vec3& operator[](int i) noexcept { return all.value[i]; }
    const Vec3& operator[](int i) const noexcept { return all.value[i]; }
    void set(int i, const Vec3& v) noexcept { all.value[i].x = v.x, all.value[i].y = v.y, all.value[i].z = v.z; }
  };

  void rate(const Hand& hand, const State& y, State& dy) const noexcept {
    // Each point stays where the curve wrote it; what follows is copied component by component.
    Unfilled<std::array<CurvePoint, kMostMasses<N>>> points;
    Vectors r, v, force, tangent;
    std::array<double, kMostMasses<N>> measure, bend;  // Tangential: 1/|r_phi| or 1/|r_phi|^2, r_phi.r_phiphi
    for (int i = 0; i < n(); ++i) curve.function(curve.program, curve.shape.data(), y[i], points.value[i]);
    for (int i = 0; i < n(); ++i) {
      const CurvePoint& p = points.value[i];
      const double square = dot(p.rPhi, p.rPhi);
      if constexpr (Tangential) {
        measure[i] = 1 / std::fmax(std::sqrt(square), 1e-290);  // on a cusp itself T is nothing, and nothing is asked of it
        tangent.set(i, measure[i] * p.rPhi);
      } else {
        measure[i] = 1 / square;
        bend[i] = dot(p.rPhi, p.rPhiPhi);
        tangent.set(i, p.rPhi);
      }
      r.set(i, p.r);
      v.set(i, y[n() + i] * tangent[i]);
    }
    springs.push(hand.position, hand.velocity, r, v, force);
    force[0] += springs.extraForce;
    for (int i = 0; i < n(); ++i) {
      const double w = y[n() + i];
      const double drive = springs.inverseMass[i] * dot(tangent[i], force[i]) + dot(tangent[i], springs.gravity);
      const double drag = springs.inverseMass[i] * springs.viscosity * w;
      if constexpr (Tangential) {
        dy[i] = w * measure[i];
        dy[n() + i] = drive - drag;
      } else {
        dy[i] = w;
        dy[n() + i] = measure[i] * (drive - bend[i] * w * w) - drag;
      }
    }
  }
  double scale(int i) const noexcept { return i < n() ? 0.1 : Tangential ? 0.1 : 1.0; }

  void place(std::span<const double> q, std::span<const double> qRate, State& y) const noexcept {
    for (int i = 0; i < n(); ++i) {
      y[i] = q[0];
      y[n() + i] = Tangential ? qRate[0] * norm(evaluate(curve, q[0]).rPhi) : qRate[0];
    }
  }
  void locate(const State& y, std::span<MassState> masses) const noexcept {
    for (std::size_t k = 0; k < masses.size(); ++k) {
      const int i = static_cast<int>(k);
      const CurvePoint p = evaluate(curve, y[i]);
      const double speed = std::fmax(norm(p.rPhi), 1e-290);
      masses[k].q = {y[i], 0};
      masses[k].qRate = {Tangential ? y[n() + i] / speed : y[n() + i], 0};
      masses[k].r = p.r;
      masses[k].v = Tangential ? (y[n() + i] / speed) * p.rPhi : y[n() + i] * p.rPhi;
    }
  }
  void accelerate(const State& y, const State& dy, std::span<MassState> masses) const noexcept {
    for (std::size_t k = 0; k < masses.size(); ++k) {
      const int i = static_cast<int>(k);
      const CurvePoint p = evaluate(curve, y[i]);
      if constexpr (Tangential) {
        // a = v' T + v^2 times the curvature vector, whose tangential part is left out
        const double square = std::fmax(dot(p.rPhi, p.rPhi), 1e-290);
        const Vec3 curvature = (p.rPhiPhi - (dot(p.rPhi, p.rPhiPhi) / square) * p.rPhi) / square;
        masses[k].a = dy[n() + i] / std::sqrt(square) * p.rPhi + y[n() + i] * y[n() + i] * curvature;
      } else {
        masses[k].a = dy[n() + i] * p.rPhi + y[n() + i] * y[n() + i] * p.rPhiPhi;
      }
    }
  }

  bool bounded() const noexcept { return !domain.periodic && (std::isfinite(domain.lo) || std::isfinite(domain.hi)); }
  bool bounces() const noexcept { return domain.atEnd == AtEnd::Bounce; }
  bool inside(const State& y) const noexcept {
    for (int i = 0; i < n(); ++i)
      if (!(y[i] >= domain.lo && y[i] <= domain.hi)) return false;
    return true;
  }
  void meetEnd(const State& beyond, State& y, bool bounce) const noexcept {
    for (int i = 0; i < n(); ++i) {
      const bool low = beyond[i] < domain.lo;
      if (!low && !(beyond[i] > domain.hi)) continue;
      y[i] = low ? domain.lo : domain.hi;
      if (bounce) y[n() + i] = low ? std::abs(y[n() + i]) : -std::abs(y[n() + i]);
    }
  }
};

}  // namespace reachlab
