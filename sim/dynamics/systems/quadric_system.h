#pragma once
#include <cmath>

#include "sim/dynamics/systems/quadric.h"
#include "sim/dynamics/systems/surface_rates.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

/// A point on a surface of second degree in world coordinates, y = (r, v). r'' = f - n (n.f + v.H v)/n.n with n the gradient, H = 2A and f
/// = F/m. There is no parametrisation and so no pole. The parameters are computed only on request. On a sphere without forces the motion is
/// a great circle in closed form.
struct QuadricSystem : SpaceSystem<Springs<1>> {
  static constexpr int kStates = 6;
  static constexpr bool kSecondOrder = true;
  static constexpr Hooks kHas{
      .ends = true, .settling = true, .losing = true, .parametrising = true, .care = true, .sight = true, .gliding = true};
  static constexpr int kProjectEvery = 8;    // ticks
  static constexpr double kBeside = 0.1;     // [m] from an apex, within which sub-steps have smaller errors
  static constexpr double kSubSteps = 0.01;  // [m] from an apex, within which there are only sub-steps
  static constexpr double kNearest = 2e-6;   // [m] from an apex, within which rounding decides where a mass leaves it
  using State = Numbers<6>;

  Quadric quadric;
  constraints::Surface surface;
  std::array<constraints::Domain, 2> domain;
  bool apex = true;    // some point has no normal (a cone)
  bool edges = false;  // the domain has an edge that is not a pole: parameters are followed
  int ticks = 0;
  mutable std::array<double, 2> parameters{};  // last known u, v: where the search for the next begins
  mutable double nearness = 1;                 // the distance from an apex over kBeside, at most 1
  mutable bool atApex = false;                 // a step came nearer than kNearest
  std::optional<Sphere> sphere;
  bool gliding = false;  // on a sphere without forces

  QuadricSystem(const ObjectModel& model, const constraints::Constraint& constraint, const Quadric& q)
      : SpaceSystem(model), quadric(q), surface(constraint.surface), domain(constraint.domain), sphere(sphereOf(q)) {
    setGliding();
  }
  static constexpr int states() noexcept { return 6; }
  void setExtraForce(const Vec3& force) noexcept {
    springs.extraForce = force;
    setGliding();
  }
  void setCoupled(const ObjectModel& model, bool coupled) noexcept {
    springs.setCoupled(model, coupled);
    setGliding();
  }

  void rate(const Hand& hand, const State& y, State& dy) const noexcept {
    const Vec3 r{y[0], y[1], y[2]}, v{y[3], y[4], y[5]};
    const Vec3 force =
        mulAdd(springs.handStiffness[0], hand.position - r, mulAdd(springs.handDamping[0], hand.velocity - v, springs.extraForce));
    const Vec3 f = mulAdd(springs.inverseMass[0], mulAdd(-springs.viscosity, v, force), springs.gravity);
    const Vec3 n = quadric.gradient(r);
    const Vec3 a = mulAdd(-(mulAdd(2, fusedDot(v, quadric.times(v)), fusedDot(n, f)) / fusedDot(n, n)), n, f);
    dy.assign(v.x, v.y, v.z, a.x, a.y, a.z);
  }
  double scale(int i) const noexcept { return (i < 3 ? kTypicalPlace : 1.0) * nearness; }

  /// [m], or less where the cone is slender.
  double distanceFromApex(const State& y) const noexcept {
    const std::array<double, 6>& a = quadric.a;
    const double bend = 2 * std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + 2 * (a[3] * a[3] + a[4] * a[4] + a[5] * a[5]));
    return norm(quadric.gradient({y[0], y[1], y[2]})) / bend;
  }
  /// The time [s] in which a mass would come to an apex, if it moved straight towards it.
  double timeToApex(const State& y) const noexcept {
    const Vec3 turn = 2.0 * quadric.times({y[3], y[4], y[5]});
    return norm(quadric.gradient({y[0], y[1], y[2]})) / std::fmax(norm(turn), 1e-300);
  }
  bool wantsSubSteps(const State& y, double dt) const noexcept {
    constexpr double kSteps = 4;
    return apex && (timeToApex(y) < kSteps * dt || distanceFromApex(y) < kSubSteps);
  }
  /// The longest sub-step, at most `most` [s]: the force of the surface turns round beside an apex.
  double reach(const State& y, const State&, double most) const noexcept {
    constexpr double kPart = 0.4;
    if (!apex) return most;
    const double time = timeToApex(y), distance = distanceFromApex(y);
    nearness = std::fmin(1, std::fmax(distance, kNearest) / kBeside);
    atApex = atApex || distance < kNearest;
    return std::fmin(most, kPart * time);
  }

  /// One step along the great circle: d and v turn by |v| dt / R in the plane that they span. False where a force acts, or where the turn
  /// is too large for the series.
  bool glide(double dt, const State& y, State& next) const noexcept {
    if (!gliding) return false;
    const Vec3 d = Vec3{y[0], y[1], y[2]} - sphere->middle, v{y[3], y[4], y[5]};
    const double share = dt / sphere->radius, turn2 = fusedDot(v, v) * (share * share);
    if (!(turn2 <= kMostTurn2)) return false;
    // cos x - 1 and sin x / x to rounding, with x^2 = turn2. The sums are small, so that their rounding, the same at each tick, does not
    // accumulate.
    const double less = turn2 * mulAdd(mulAdd(mulAdd(turn2, 1.0 / 40320, -1.0 / 720), turn2, 1.0 / 24), turn2, -0.5);
    const double sine = mulAdd(mulAdd(mulAdd(mulAdd(turn2, 1.0 / 362880, -1.0 / 5040), turn2, 1.0 / 120), turn2, -1.0 / 6), turn2, 1.0);
    const Vec3 r = mulAdd(sine * dt, v, less * d), w = mulAdd(-(sine * (turn2 / dt)), d, less * v);
    next.assign(y[0] + r.x, y[1] + r.y, y[2] + r.z, v.x + w.x, v.y + w.y, v.z + w.z);
    return true;
  }

  /// Projects the state onto the surface every few ticks. This removes the drift of rounding, far below the errors that a multistep history
  /// notices. Lost where the normal turned round within the step, at the apex of a cone, because the continuation is undetermined there.
  Settled settle(const State& before, State& y) noexcept {
    const bool met = atApex;
    atApex = false;
    if (met) return Settled::Lost;
    const bool project = ++ticks % kProjectEvery == 0;
    if (!project && !apex) return Settled::Same;
    Vec3 r{y[0], y[1], y[2]}, v{y[3], y[4], y[5]};
    const Vec3 n = quadric.gradient(r), nBefore = quadric.gradient({before[0], before[1], before[2]});
    if (dot(n, nBefore) < 0 && lost(before)) return Settled::Lost;
    if (!project) return Settled::Same;
    // The length of the normal at the tick before is enough, because the drift is rounding. Waiting for the length at this tick would cost
    // a division.
    const double square = 1 / fusedDot(nBefore, nBefore);
    r = mulAdd(-(quadric.value(r) * square), n, r);
    v = mulAdd(-(fusedDot(n, v) * square), n, v);
    y.assign(r.x, r.y, r.z, v.x, v.y, v.z);
    return Settled::Same;
  }
  /// True beside a place without a normal. The gradient has a length of about 1 elsewhere.
  bool lost(const State& y) const noexcept { return norm(quadric.gradient({y[0], y[1], y[2]})) < 0.1; }

  void place(std::span<const double> q, std::span<const double> qRate, State& y) noexcept {
    const constraints::SurfacePoint p = constraints::evaluate(surface, q[0], q[1]);
    const Vec3 v = qRate[0] * p.rU + qRate[1] * p.rV;
    y.assign(p.r.x, p.r.y, p.r.z, v.x, v.y, v.z);
    parameters = {q[0], q[1]};
    ticks = 0;
    atApex = false;
  }
  void locate(const State& y, std::span<MassState> masses) const noexcept {
    masses[0].r = {y[0], y[1], y[2]};
    masses[0].v = {y[3], y[4], y[5]};
  }
  void parametrise(std::span<MassState> masses) const noexcept {
    follow(masses[0].r);
    masses[0].q = parameters;
    const constraints::SurfacePoint p = constraints::evaluate(surface, parameters[0], parameters[1]);
    masses[0].qRate = solveRates(p, masses[0].v);
  }
  void accelerate(const State&, const State& dy, std::span<MassState> masses) const noexcept { masses[0].a = {dy[3], dy[4], dy[5]}; }

  std::string stopReason(StepStatus status, const State&) const {
    return plainReason(status,
                       "the surface has no tangent plane here (a cone's apex), or the mass is within 2 micrometres of it: which way it "
                       "leaves is not determined");
  }

  bool bounded() const noexcept { return edges; }
  bool bounces() const noexcept { return domain[0].atEnd == constraints::AtEnd::Bounce || domain[1].atEnd == constraints::AtEnd::Bounce; }
  bool inside(const State& y) const noexcept {
    follow({y[0], y[1], y[2]});
    constexpr double kRounding = 1e-12;  // of the search: a mass that was just thrown back from an edge is inside
    for (int k = 0; k < 2; ++k)
      if (!domain[k].periodic && !(parameters[k] >= domain[k].lo - kRounding && parameters[k] <= domain[k].hi + kRounding)) return false;
    return true;
  }
  void meetEnd(const State& beyond, State& y, bool bounce) const noexcept;

  /// Follows the parameters to r by Gauss-Newton from their last values. If r is far off, the search starts from the nearest point of a
  /// grid.
  void follow(const Vec3& r) const noexcept;

 private:
  static constexpr double kMostTurn2 = 0.01;  // [rad^2], where the next terms are 3e-17

  void setGliding() noexcept {
    gliding = sphere && springs.handStiffness[0] == 0 && springs.handDamping[0] == 0 && springs.viscosity == 0 &&
              springs.gravity == Vec3{} && springs.extraForce == Vec3{};
  }
};

}  // namespace reachlab::dynamics
