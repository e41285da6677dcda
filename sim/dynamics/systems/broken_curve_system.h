#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "constraints/regularity/places.h"
#include "sim/dynamics/systems/curve_places.h"

namespace reachlab::dynamics {

/// A curve whose formula is smooth by pieces only. Each mass moves on the branch of its piece, with the speed along the curve as velocity.
/// Events (Adaptive::stepInside) bring the mass onto the ends of the piece.
///   Passed (kink, bend, hole): it goes on into the next piece with the speed it has; the forces act along the new tangent.
///   Not passed (jump, pole, end, spike): what `at_end` says.
/// A mass rests in a kink into which both sides push it, as soon as its swing would last less than kSwing of a step. It leaves the kink
/// when a side pulls it out.
template <int N>
struct BrokenCurveSystem : SpaceSystem<Springs<N>> {
  using Space = SpaceSystem<Springs<N>>;
  using Space::springs, typename Space::Hand;
  static constexpr int kStates = 2 * N;
  static constexpr bool kTangential = true;
  static constexpr bool kSecondOrder = false;
  static constexpr Hooks kHas{
      .ends = true, .branches = true, .holding = true, .care = true, .pieces = true, .sight = true, .leadRate = true};
  static constexpr double kSwing = 1.0 / 30;
  using State = Numbers<kStates>;
  std::shared_ptr<const constraints::CurveRegularity> regularity;
  constraints::Domain domain;
  double speedScale;  // [m] typical |r_phi|
  int count;
  struct Where {
    int piece = 0;
    bool held = false;  // at rest on its piece's lower end, in the corner of a kink
  };
  std::array<Where, kMassCapacity<N>> where{};
  int stoppedMass = -1;
  bool stoppedLow = false;

  BrokenCurveSystem(const ObjectModel& model, const constraints::Constraint& constraint,
                    std::shared_ptr<const constraints::CurveRegularity> pieces, double typicalSpeed)
      : Space(model), regularity(std::move(pieces)), domain(constraint.domain[0]), speedScale(typicalSpeed), count(model.count()) {}

  constexpr int n() const noexcept { return N > 0 ? N : count; }
  constexpr int rates() const noexcept { return n(); }
  constexpr int states() const noexcept { return 2 * n(); }
  const constraints::CurvePiece& pieceOf(int i) const noexcept { return regularity->pieces[where[i].piece]; }
  const constraints::Curve& curveOf(int i) const noexcept { return pieceOf(i).curve; }
  double speedAt(int i, double phi) const noexcept { return norm(evaluate(curveOf(i), phi).rPhi); }
  double scale(int) const noexcept { return kTypicalPlace; }
  /// The longest sub-step, at most `most` [s], in which no mass moves farther than its narrow places allow.
  double reach(const State& y, const State& rates, double most) const noexcept {
    double least = most;
    if (regularity->narrow.empty()) return least;
    for (int i = 0; i < n(); ++i) {
      const double rate = rates[i], speed = y[n() + i], slope = speed != 0 ? rates[n() + i] * (rate / speed) : 0;
      double way = regularity->reachFrom(y[i], rate > 0);
      if (!(rate * slope > 0)) way = std::fmin(way, regularity->reachFrom(y[i], !(rate > 0)));  // it may turn round
      least = std::fmin(least, 2 * way / (std::abs(rate) + std::sqrt(rate * rate + 2 * std::abs(slope) * way)));
    }
    return least;
  }
  /// True where only sub-steps can continue: phi is needed more exactly than usual, or a narrow place lies within the way of a step.
  bool wantsSubSteps(const State& y, double dt) const noexcept { return isSteep(y) || meetsNarrow(y, dt); }
  bool isSteep(const State& y) const noexcept {
    constexpr double kSteep = 4;
    return steepness(y) > kSteep;
  }
  bool meetsNarrow(const State& y, double dt) const noexcept {
    constexpr double kFaster = 0.05;  // [m/s] that a mass may become within a step
    if (regularity->narrow.empty()) return false;
    for (int i = 0; i < n(); ++i) {
      const double way = (std::abs(y[n() + i]) + kFaster) * dt / std::fmax(speedAt(i, y[i]), 1e-290);
      if (way > std::fmin(regularity->reachFrom(y[i], true), regularity->reachFrom(y[i], false))) return true;
    }
    return false;
  }
  /// The distance that a unit of phi moves a mass, relative to the usual distance. It has no bound towards the end of an arc, a root or a
  /// power.
  double steepness(const State& y) const noexcept {
    double most = 1;
    for (int i = 0; i < n(); ++i) most = std::fmax(most, speedAt(i, y[i]) / speedScale);
    return most;
  }

  using Vectors = std::array<Vec3, kMassCapacity<N>>;
  /// Force over mass on each mass [m/s^2], without viscosity, and the quantities of the curve that the equations need.
  void push(const Hand& hand, const State& y, Vectors& drive, Vectors& tangent, std::array<double, kMassCapacity<N>>& measure,
            int lead = -1, double* speed = nullptr) const noexcept {
    Vectors r, v;
    for (int i = 0; i < n(); ++i) {
      const constraints::CurvePoint p = evaluate(curveOf(i), y[i]);
      const double length = norm(p.rPhi);
      if (i == lead) *speed = length;
      measure[i] = 1 / std::fmax(length, 1e-290);
      tangent[i] = measure[i] * p.rPhi;
      r[i] = p.r;
      v[i] = y[n() + i] * tangent[i];
    }
    springs.push(hand.position, hand.velocity, r, v, drive);
    drive[0] += springs.extraForce;
    for (int i = 0; i < n(); ++i) drive[i] = springs.inverseMass[i] * drive[i] + springs.gravity;
  }
  void rate(const Hand& hand, const State& y, State& dy) const noexcept {
    double none = 0;
    rate(hand, y, dy, -1, none);
  }
  /// The rate, and |r_phi| [m] of mass `lead` from the same evaluation.
  void rate(const Hand& hand, const State& y, State& dy, int lead, double& speed) const noexcept {
    Vectors drive, tangent;
    std::array<double, kMassCapacity<N>> measure;
    push(hand, y, drive, tangent, measure, lead, &speed);
    for (int i = 0; i < n(); ++i) {
      const double v = y[n() + i];
      dy[i] = where[i].held ? 0 : v * measure[i];
      dy[n() + i] = where[i].held ? 0 : dot(tangent[i], drive[i]) - springs.inverseMass[i] * springs.viscosity * v;
    }
  }

  void place(std::span<const double> q, std::span<const double> qRate, State& y) noexcept {
    const int found = std::max(0, regularity->pieceAt(q[0]));
    const constraints::CurvePiece& piece = regularity->pieces[found];
    const bool corner = q[0] == piece.lo && piece.passedAtLo;
    const bool backwards = corner && qRate[0] < 0;
    for (int i = 0; i < n(); ++i) {
      where[i] = {found - (backwards ? 1 : 0), corner && qRate[0] == 0};
      y[i] = q[0];
      y[n() + i] = qRate[0] * speedAt(i, q[0]);
    }
    stoppedMass = -1;
  }
  void locate(const State& y, std::span<MassState> masses) const noexcept {
    for (std::size_t k = 0; k < masses.size(); ++k) {
      const int i = static_cast<int>(k);
      const constraints::CurvePoint p = evaluate(curveOf(i), y[i]);
      const double omega = y[n() + i] / std::fmax(norm(p.rPhi), 1e-290);
      masses[k].q = {y[i], 0};
      masses[k].qRate = {omega, 0};
      masses[k].r = p.r;
      masses[k].v = omega * p.rPhi;
    }
  }
  void accelerate(const State& y, const State& dy, std::span<MassState> masses) const noexcept {
    for (std::size_t k = 0; k < masses.size(); ++k) {
      const int i = static_cast<int>(k);
      const constraints::CurvePoint p = evaluate(curveOf(i), y[i]);
      const double square = std::fmax(dot(p.rPhi, p.rPhi), 1e-290), v = y[n() + i];
      masses[k].a = dy[n() + i] / std::sqrt(square) * p.rPhi + v * v / square * (p.rPhiPhi - (dot(p.rPhi, p.rPhiPhi) / square) * p.rPhi);
    }
  }

  static constexpr bool bounded() noexcept { return true; }
  bool bounces() const noexcept { return domain.atEnd == constraints::AtEnd::Bounce; }
  bool inside(const State& y) const noexcept {
    for (int i = 0; i < n(); ++i)
      if (const constraints::CurvePiece& piece = pieceOf(i); !(y[i] >= piece.lo && y[i] <= piece.hi)) return false;
    return true;
  }
  /// True if a mass turned round within the step so near an end that it may have been beyond it in between.
  bool turned(const State& from, const State& to, double dt) const noexcept {
    for (int i = 0; i < n(); ++i) {
      const double v = from[n() + i];
      if (!(v * to[n() + i] < 0)) continue;
      const constraints::CurvePiece& piece = pieceOf(i);
      const double reach = std::abs(v) * dt / std::fmax(speedAt(i, from[i]), 1e-290);
      if (v > 0 ? std::fmax(from[i], to[i]) + reach > piece.hi : std::fmin(from[i], to[i]) - reach < piece.lo) return true;
    }
    return false;
  }

  auto branch() const noexcept { return where; }
  void takeBack(const std::array<Where, kMassCapacity<N>>& before) noexcept { where = before; }
  /// Moves each mass that `beyond` shows behind a passed end into the next piece. False if a mass may not pass.
  bool passEnds(const State& beyond, State& y, const Hand& hand, double dt) noexcept {
    for (int i = 0; i < n(); ++i) {
      const constraints::CurvePiece& piece = pieceOf(i);
      const bool low = beyond[i] < piece.lo;
      if (!low && !(beyond[i] > piece.hi)) continue;
      if (!(low ? piece.passedAtLo : piece.passedAtHi)) {
        stoppedMass = i;
        stoppedLow = low;
        return false;
      }
      y[i] = low ? piece.lo : piece.hi;
      const double behind = slopeOf(i, y, hand);
      where[i].piece += low ? -1 : 1;
      const double ahead = slopeOf(i, y, hand), side = low ? -1 : 1, v = std::abs(y[n() + i]);
      if (side * behind > 0 && side * ahead < 0 && 2 * v < kSwing * dt * std::abs(ahead)) {
        y[n() + i] = 0;
        if (low) ++where[i].piece;  // held at the lower end of its piece
        where[i].held = true;
      }
    }
    return true;
  }
  /// Resting masses that a side pulls out of their kink by now, or by the step's end, start to move. False if both sides pull.
  bool release(const Hand& begin, const Hand& end, const State& y) noexcept {
    for (int i = 0; i < n(); ++i) {
      if (!where[i].held) continue;
      for (const Hand& hand : {begin, end}) {
        const bool up = slopeOf(i, y, hand) > 0;
        --where[i].piece;
        const bool down = slopeOf(i, y, hand) < 0;
        if (up || !down) ++where[i].piece;
        if (up && down) return false;
        where[i].held = !(up || down);
        if (!where[i].held) break;
      }
    }
    return true;
  }
  bool anyHeld() const noexcept {
    for (int i = 0; i < n(); ++i)
      if (where[i].held) return true;
    return false;
  }

  std::string stopReason(StepStatus status, const State& y) const {
    if (status == StepStatus::AtEnd) return endReason();
    if (status == StepStatus::Capped || status == StepStatus::NotFinite) return troubleReason(y);
    return plainReason(status,
                       "the mass rests on a cusp, or on a kink that pulls it to both sides: which way it would leave is not determined");
  }
  std::string endReason() const {
    if (stoppedMass < 0) return "a mass reached the end of the constraint's domain";
    const constraints::CurvePiece& piece = pieceOf(stoppedMass);
    const int place = stoppedLow ? piece.placeAtLo : piece.placeAtHi;
    const std::string mass = fmt::format("mass {} at phi = {:.9g}", stoppedMass + 1, stoppedLow ? piece.lo : piece.hi);
    if (place >= 0)
      return mass + " met a place that is never crossed: " + describe(regularity->places[place], constraints::ConstraintKind::Curve);
    const double end = stoppedLow ? piece.lo : piece.hi;
    if (end == domain.lo || end == domain.hi) return mass + " reached the end of the constraint's domain";
    const bool unseen = end == regularity->seenLo || end == regularity->seenHi;
    return mass + fmt::format(" left what was examined: {} of the formula were looked for from {:.6g} to {:.6g} only",
                              unseen ? "bends too short for a step" : "kinks and jumps", unseen ? regularity->seenLo : regularity->lo,
                              unseen ? regularity->seenHi : regularity->hi);
  }
  /// The positions of the masses when no step can continue, relative to the nearest place of the curve.
  std::string troubleReason(const State& y) const {
    std::string told;
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < n(); ++i)
      for (const constraints::Place& place : regularity->places)
        if (const double distance = std::abs(place.at - y[i]); distance < nearest) {
          nearest = distance;
          told = fmt::format("mass {} at phi = {:.9g}, {:.2g} from a {}; the formula loses its digits there", i + 1, y[i], distance,
                             describe(place, constraints::ConstraintKind::Curve));
        }
    for (int i = 0; i < n(); ++i)
      for (const constraints::NarrowPlace& place : regularity->narrow)
        if (const double at = std::clamp(y[i], place.lo, place.hi); std::abs(at - y[i]) < nearest) {
          nearest = std::abs(at - y[i]);
          told = fmt::format("mass {} at phi = {:.9g}, by phi = {:.9g}, where the curve turns within {:.2g}", i + 1, y[i], at, place.reach);
        }
    return told;
  }
  void meetEnd(const State& beyond, State& y, bool bounce) const noexcept {
    for (int i = 0; i < n(); ++i) putOnEnd(beyond[i], pieceOf(i).lo, pieceOf(i).hi, bounce, y[i], y[n() + i]);
  }

 private:
  /// d(speed)/dt without viscosity [m/s^2].
  double slopeOf(int i, const State& y, const Hand& hand) const noexcept {
    Vectors drive, tangent;
    std::array<double, kMassCapacity<N>> measure;
    push(hand, y, drive, tangent, measure);
    return dot(tangent[i], drive[i]);
  }
};

}  // namespace reachlab::dynamics
