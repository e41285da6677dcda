#pragma once
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "constraints/regularity/period.h"
#include "sim/dynamics/systems/surface_rates.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

inline constexpr double kFarPhi = 512;  // beyond it the rounding of phi is checked, or turns are taken off
/// The largest movement [m] of a mass by a rounding of phi, since such movements add up tick by tick. On a curve that lies far away r
/// itself has no more digits.
inline double allowedRounding(const constraints::CurvePoint& p) { return 1e-13 + 1e-15 * norm(p.r); }
inline double roundingOfPhi(const constraints::CurvePoint& p, double phi) { return 0x1p-53 * std::abs(phi) * norm(p.rPhi); }

/// The masses of a system on a curve. phi_i is number i of the state. omega_i (Tangential: the speed v_i) is number rates() + i. `N` is the
/// number of masses, or 0 for the number in the model. `Room` is the number of places for the phi, or 0 for as many as masses.
template <int N, int Room, bool Tangential>
struct CurvePlaces {
  static constexpr bool kTangential = Tangential;
  static constexpr bool kSecondOrder = !Tangential;
  static constexpr Hooks kHas{.ends = true, .settling = true};

  constraints::Curve curve;
  constraints::Domain domain;
  double speedScale;  // [m] typical |r_phi|
  int count, room;
  constraints::Period period;  // whole turns of it are taken off phi, where it has become large, and counted here
  std::array<double, kMassCapacity<N>> turns{};
  int ticks = 0;
  double seenLo = -std::numeric_limits<double>::infinity(),
         seenHi = std::numeric_limits<double>::infinity();  // short bends are known between

  CurvePlaces(const ObjectModel& model, const constraints::Constraint& constraint, double typicalSpeed, int roomForPhi)
      : curve(constraint.curve), domain(constraint.domain[0]), speedScale(typicalSpeed), count(model.count()), room(roomForPhi),
        period(bounded() ? constraints::Period{} : constraints::findPeriod(constraint)) {}
  constexpr int n() const noexcept { return N > 0 ? N : count; }
  constexpr int rates() const noexcept { return Room > 0 ? Room : room; }
  constexpr int states() const noexcept { return 2 * rates(); }
  const constraints::Curve& curveOf(int) const noexcept { return curve; }
  double speedAt(int, double phi) const noexcept { return norm(evaluate(curve, phi).rPhi); }
  double scale(int i) const noexcept { return i < rates() || Tangential ? kTypicalPlace : 1.0; }

  /// Puts all masses at one place, and the unused room too.
  template <class State>
  void place(std::span<const double> q, std::span<const double> qRate, State& y) noexcept {
    for (int i = 0; i < rates(); ++i) {
      y[i] = q[0];
      y[rates() + i] = i >= n() ? 0 : Tangential ? qRate[0] * speedAt(0, q[0]) : qRate[0];
    }
    turns = {};
    ticks = 0;
    for (int i = 0; i < n(); ++i)
      if (std::abs(y[i]) > kFarPhi && period.turn > 0) takeTurnsOff(i, y);
  }
  template <class State>
  void takeTurnsOff(int i, State& y) noexcept {
    const double whole = std::nearbyint(y[i] / period.turn);
    y[i] = std::fma(-whole, period.rest, std::fma(-whole, period.turn, y[i]));
    turns[i] += whole;
  }
  double phiOf(int i, double phi) const noexcept {
    return turns[i] == 0 ? phi : std::fma(turns[i], period.turn, std::fma(turns[i], period.rest, phi));
  }
  bool isUnseen(double phi) const noexcept { return phi < seenLo || phi > seenHi; }
  /// A phi that has grown large loses digits of the position. Whole turns are taken off, or the motion ends.
  template <class State>
  Settled settle(const State&, State& y) noexcept {
    constexpr int kLookEvery = 64;  // ticks
    if (++ticks % kLookEvery != 0) return Settled::Same;
    for (int i = 0; i < n(); ++i) {
      bool lost = isUnseen(phiOf(i, y[i]));
      if (std::abs(y[i]) > kFarPhi && !lost) {
        if (period.turn > 0) takeTurnsOff(i, y);
        else if (const constraints::CurvePoint p = evaluate(curve, y[i]); roundingOfPhi(p, y[i]) > allowedRounding(p)) lost = true;
      }
      if (!lost) continue;
      --ticks;  // a shorter step is looked at again
      return Settled::Lost;
    }
    return Settled::Same;
  }
  template <class State>
  std::string stopReason(StepStatus status, const State& y) const {
    if (status == StepStatus::Capped || status == StepStatus::NotFinite) return troubleReason(y);
    return status == StepStatus::NoContinuation ? lostReason(y) : plainReason(status, "");
  }
  template <class State>
  std::string lostReason(const State& y) const {
    for (int i = 0; i < n(); ++i)
      if (const double phi = phiOf(i, y[i]); isUnseen(phi))
        return fmt::format(
            "mass {} at phi = {:.9g} left what was examined: bends too short for a step were looked for from {:.6g} to {:.6g} only", i + 1,
            phi, seenLo, seenHi);
    for (int i = 0; i < n(); ++i)
      if (const constraints::CurvePoint p = evaluate(curve, y[i]); roundingOfPhi(p, y[i]) > allowedRounding(p))
        return fmt::format("mass {} at phi = {:.6g}, so far from 0 that a rounding of phi moves it by {:.2g} m, in every tick", i + 1, y[i],
                           roundingOfPhi(p, y[i]));
    return "the mass rests on a cusp of the curve: which way it would leave is not determined";
  }
  template <class State>
  void locate(const State& y, std::span<MassState> masses) const noexcept {
    for (std::size_t k = 0; k < masses.size(); ++k) {
      const double phi = y[static_cast<int>(k)], rate = y[rates() + static_cast<int>(k)];
      const constraints::CurvePoint p = constraints::evaluate(curve, phi);
      const double omega = Tangential ? rate / std::fmax(norm(p.rPhi), 1e-290) : rate;
      masses[k].q = {phiOf(static_cast<int>(k), phi), 0};
      masses[k].qRate = {omega, 0};
      masses[k].r = p.r;
      masses[k].v = omega * p.rPhi;
    }
  }
  template <class State>
  void accelerate(const State& y, const State& dy, std::span<MassState> masses) const noexcept {
    for (std::size_t k = 0; k < masses.size(); ++k) {
      const int i = static_cast<int>(k);
      const double rate = y[rates() + i], slope = dy[rates() + i];
      const constraints::CurvePoint p = constraints::evaluate(curve, y[i]);
      if constexpr (Tangential) {
        // a = v' T + v^2 times the curvature vector, whose tangential part is left out
        const double square = std::fmax(dot(p.rPhi, p.rPhi), 1e-290);
        const Vec3 curvature = (p.rPhiPhi - (dot(p.rPhi, p.rPhiPhi) / square) * p.rPhi) / square;
        masses[k].a = slope / std::sqrt(square) * p.rPhi + rate * rate * curvature;
      } else {
        masses[k].a = slope * p.rPhi + rate * rate * p.rPhiPhi;
      }
    }
  }

  /// The reason where no step can continue: a curve of finite length whose end phi never reaches.
  template <class State>
  std::string troubleReason(const State& y) const {
    constexpr double kFar = 1e3, kStill = 1e-5;
    for (int i = 0; i < n(); ++i)
      if (const double speed = speedAt(i, y[i]); std::abs(y[i]) > kFar && !(speed > kStill * speedScale))
        return fmt::format(
            "mass {} at phi = {:.3g}, where |r_phi| has fallen to {:.2g} m: the curve comes to its end only as phi grows without bound",
            i + 1, y[i], speed);
    return {};
  }

  bool bounded() const noexcept { return !domain.periodic && (std::isfinite(domain.lo) || std::isfinite(domain.hi)); }
  bool bounces() const noexcept { return domain.atEnd == constraints::AtEnd::Bounce; }
  template <class State>
  bool inside(const State& y) const noexcept {
    for (int i = 0; i < n(); ++i)
      if (!(y[i] >= domain.lo && y[i] <= domain.hi)) return false;
    return true;
  }
  template <class State>
  void meetEnd(const State& beyond, State& y, bool bounce) const noexcept {
    for (int i = 0; i < n(); ++i) putOnEnd(beyond[i], domain.lo, domain.hi, bounce, y[i], y[rates() + i]);
  }
};

}  // namespace reachlab::dynamics
