#pragma once
#include <array>
#include <vector>

#include "sim/dynamics/curve_places.h"
#include "sim/dynamics/octet_springs.h"

namespace reachlab::dynamics {

/// The equations of CurveSystem for two and more masses, eight at a time in the lanes of vector registers. `Octets` registers for the
/// masses, 0: as many as they need. Lanes without a mass rest at the first mass's start.
template <int Octets, bool Parallel, bool Tangential>
struct OctetSystem : CurvePlaces<0, Octets * constraints::kOctet, Tangential> {
  using Places = CurvePlaces<0, Octets * constraints::kOctet, Tangential>;
  using Places::curve, Places::rates;
  static constexpr int kStates = 2 * Octets * constraints::kOctet;
  using State = Numbers<kStates>;
  using Hand = HandSample;

  OctetSprings<Octets, Parallel> springs;

  OctetSystem(const ObjectModel& model, const constraints::Constraint& constraint, double typicalSpeed)
      : Places(model, constraint, typicalSpeed, octetsFor(model.count()) * constraints::kOctet), springs(model) {}
  void setExtraForce(const Vec3& force) noexcept { springs.extraForce = force; }
  Hand handAt(const HandSegment& hand, double s) const noexcept { return sampleAt(hand, s); }
  Hand handOf(const HandSample& hand) const noexcept { return hand; }

  void rate(const Hand& hand, const State& y, State& dy) const noexcept {
    constraints::Unfilled<std::array<constraints::CurveOctet, kMostOctets<Octets>>> points;
    constraints::Unfilled<std::array<OctetMotion, kMostOctets<Octets>>> motions;
    for (int o = 0; o < springs.octets(); ++o) {
      constraints::CurveOctet& p = points.value[o];
      curve.octet(curve.program, curve.shape.data(), &y[o * constraints::kOctet], p);
      OctetMotion& m = motions.value[o];
      const Octet tx = load(p.rPhi[0]), ty = load(p.rPhi[1]), tz = load(p.rPhi[2]), square = mulAdd(tx, tx, mulAdd(ty, ty, tz * tz));
      if constexpr (Tangential)
        m.measure = 1.0 / atLeast(squareRoot(square), 1e-290);  // on a cusp T is nothing, and nothing is asked of it
      else m.measure = 1.0 / square;
      const Octet w = load(&y[rates() + o * constraints::kOctet]), speed = Tangential ? w * m.measure : w;
      m.r[0] = load(p.r[0]), m.r[1] = load(p.r[1]), m.r[2] = load(p.r[2]);
      m.v[0] = speed * tx, m.v[1] = speed * ty, m.v[2] = speed * tz;
    }
    std::array<Octet, 3> tension{};
    for (int o = 0; o < springs.octets(); ++o) {
      const constraints::CurveOctet& p = points.value[o];
      const OctetMotion& m = motions.value[o];
      const Octet w = load(&y[rates() + o * constraints::kOctet]);
      Octet drive{}, bend{};
      for (int k = 0; k < 3; ++k) {
        const Octet t = load(p.rPhi[k]);
        drive = mulAdd(t, springs.acceleration(hand, motions.value.data(), o, k, tension[k]), drive);
        if constexpr (!Tangential) bend = mulAdd(t, load(p.rPhiPhi[k]), bend);
      }
      const Octet drag = springs.row[o].drag * w;
      Octet slope;
      if constexpr (Tangential) {
        store(w * m.measure, dy, o * constraints::kOctet);
        slope = mulAdd(m.measure, drive, -drag);
      } else {
        store(w, dy, o * constraints::kOctet);
        slope = mulAdd(m.measure, mulAdd(-bend, w * w, drive), -drag);
      }
      store(springs.row[o].used ? slope : Octet{}, dy, rates() + o * constraints::kOctet);
    }
  }

 private:
  static Octet load(const double* from) noexcept { return loadLanes<Octet>(from); }
  static void store(const Octet& x, State& to, int first) noexcept { storeLanes(x, &to[first]); }
};

}  // namespace reachlab::dynamics
