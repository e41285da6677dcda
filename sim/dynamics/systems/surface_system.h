#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "constraints/regularity/surface_branches.h"
#include "constraints/regularity/surface_watch.h"
#include "sim/dynamics/systems/polar_chart.h"
#include "sim/dynamics/systems/surface_rates.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

/// A point on a surface in the parameters of the surface, or in a polar chart near a pole. Poles are found during the motion on any
/// surface. y = (u, v, u', v'), Eq. (13): G q'' = a^T (F/m - w), w = r_uu u'^2 + 2 r_uv u'v' + r_vv v'^2.
struct SurfaceSystem : SpaceSystem<Springs<1>> {
  static constexpr int kStates = 4;
  static constexpr bool kSecondOrder = true;
  static constexpr Hooks kHas{
      .ends = true, .branches = true, .settling = true, .losing = true, .care = true, .careful = true, .sight = true};
  /// Squared sine of the angle between r_u and r_v. Below the first, the tolerance of the rates would show in the speed, and they are
  /// computed more exactly. Below the second, the eleventh digit of the speed is lost to their rounding.
  static constexpr double kOblique = 1e-3, kParallel = 1e-9;
  static constexpr double kDegenerate = 1e-7;  // of the largest |r_u x r_v|^2: below, r_u and r_v span no plane
  static constexpr double kThin = 1e-3;        // of the same: below, a typed surface may come to an apex within the next steps
  static constexpr double kLong = 1;           // [m^2] |r_u|^2 or |r_v|^2 above which the rates' tolerance would show in the speed
  static constexpr double kShows = 5e-11;      // of the speed: what a rounding of u or v may change
  static constexpr int kLookEvery = 4;         // steps between looks for a pole
  static constexpr double kTightening = 0.01;  // of the tolerance, where the rates nearly cancel in the velocity
  using State = Numbers<4>;

  constraints::Surface surface;  // as defined
  constraints::Surface active;   // what the state's parameters are: `surface`, or `polar` while `inPolar`
  std::array<constraints::Domain, 2> domain;
  PolarChart polar;
  bool inPolar = false;
  int ticks = 0, waiting = 0;                          // between looks for a pole
  double startArea = 0;                                // [m^4] the largest about the start
  double largestU = 0, largestV = 0, largestArea = 0;  // [m^2], [m^2], [m^4] the largest |r_u|^2, |r_v|^2, |r_u x r_v|^2 seen so far

  /// Lines across which the formula is not smooth. Null for a surface without them. A crease (abs) is passed as the geodesic does. The
  /// velocity along the crease stays. The part across it turns into the tangent plane of the new side. Jumps, poles and ends are never
  /// crossed.
  std::shared_ptr<const constraints::SurfaceBranches> branches;
  std::shared_ptr<constraints::SurfaceWatch> watch;  // null on a definition of the catalogue
  struct Where {
    int branch = 0;
    std::array<signed char, constraints::SurfaceBranches::kMaxGuards> side{};  // sign of each line's argument - level
  };
  Where where;
  int metLine = -1;  // the line that stopped the mass
  /// Places that the right-hand sides of this step met.
  struct Met {
    bool flat = false;     // r_u and r_v spanned next to no plane
    bool oblique = false;  // r_u and r_v came near each other, see kOblique and kParallel
    bool parallel = false;
    bool longRate = false;   // |r_u|^2 or |r_v|^2 was above kLong
    bool thin = false;       // an apex may be near
    bool besideEnd = false;  // a line at which the formula ends was near
  };
  mutable Met met;
  /// True where parameters and rates are needed more exactly. Where the parameter lines are oblique the rates nearly cancel in the
  /// velocity. Where r_u is long an error of the parameter is an error of many metres. Beside an end r_u grows without bound.
  bool careful = false;
  bool rounded = false;  // a step was lost to the rounding of u and v
  /// The smallest distance of a mass from a line at which the formula ends, in the argument of the line. Nearer, the rounding of the
  /// argument shows in the speed.
  std::array<double, constraints::SurfaceBranches::kMaxGuards> margin{};

  SurfaceSystem(const ObjectModel& model, const constraints::Constraint& constraint)
      : SpaceSystem(model), surface(constraint.surface), active(constraint.surface), domain(constraint.domain) {}
  static constexpr int states() noexcept { return 4; }

  void rate(const Hand& hand, const State& y, State& dy) const noexcept {
    constraints::Unfilled<constraints::SurfacePoint> room;
    active.function(active.program, active.shape.data(), y[0], y[1], room.value);
    const constraints::SurfacePoint& p = room.value;
    const double du = y[2], dv = y[3], drag = springs.inverseMass[0] * springs.viscosity;
    const Vec3 velocity = mulAdd(du, p.rU, dv * p.rV);
    const Vec3 bend = mulAdd(du * du, p.rUu, mulAdd(2 * du * dv, p.rUv, (dv * dv) * p.rVv));
    const Vec3 force =
        mulAdd(springs.handStiffness[0], hand.position - p.r, mulAdd(springs.handDamping[0], hand.velocity - velocity, springs.extraForce));
    const Vec3 drive = mulAdd(springs.inverseMass[0], force, springs.gravity - bend);
    const double e = fusedDot(p.rU, p.rU), f = fusedDot(p.rU, p.rV), g = fusedDot(p.rV, p.rV);
    const double determinant = mulAdd(e, g, -(f * f));
    const double a = fusedDot(p.rU, drive), b = fusedDot(p.rV, drive), inverse = 1 / determinant;
    // If the lines are less oblique than the limit of flatness, they are neither flat nor parallel. One comparison decides this in nearly
    // all cases.
    const double awayFromOblique = mulAdd(-kOblique * e, g, determinant),
                 flatBelow = (watch == nullptr ? kDegenerate : kThin) * largestArea;
    if (!(awayFromOblique > flatBelow && std::max(e, g) <= kLong)) [[unlikely]] {
      met.flat |= determinant < kDegenerate * largestArea;
      met.thin |= determinant < flatBelow;
      met.oblique |= awayFromOblique < 0;
      met.parallel |= mulAdd(-kParallel * e, g, determinant) < 0;
      met.longRate |= e > kLong || g > kLong;
    }
    if (careful) [[unlikely]] {
      // By vectors at right angles to r_v and r_u: e g - f^2 would lose twice the digits.
      const Vec3 area = cross(p.rU, p.rV);
      const double whole = dot(area, area);
      dy.assign(du, dv, dot(drive, cross(p.rV, area)) / whole - drag * du, dot(drive, cross(area, p.rU)) / whole - drag * dv);
      return;
    }
    dy.assign(du, dv, mulAdd(mulAdd(g, a, -(f * b)), inverse, -(drag * du)), mulAdd(mulAdd(e, b, -(f * a)), inverse, -(drag * dv)));
  }
  double scale(int i) const noexcept { return i < 2 ? kTypicalPlace : 1.0; }

  void place(std::span<const double> q, std::span<const double> qRate, State& y) noexcept {
    y.values = {q[0], q[1], qRate[0], qRate[1]};
    inPolar = false;
    metLine = -1;
    met = {};
    careful = false;
    if (branches != nullptr) findBranch(q, qRate);
    active = surface;
    ticks = waiting = 0;
    startArea = 0;
    for (int i = 0; i < 16; ++i) look(constraints::evaluate(surface, q[0] + 0.4 * (i % 4), q[1] + 0.4 * (i / 4)));
    startArea = largestArea;
  }
  void locate(const State& y, std::span<MassState> masses) const noexcept {
    const constraints::SurfacePoint p = constraints::evaluate(active, y[0], y[1]);
    masses[0].r = p.r;
    masses[0].v = y[2] * p.rU + y[3] * p.rV;
    masses[0].q = {y[0], y[1]};
    masses[0].qRate = {y[2], y[3]};
    if (!inPolar) return;
    masses[0].q = polar.toBase(y[0], y[1]);
    masses[0].qRate = solveRates(constraints::evaluate(surface, masses[0].q[0], masses[0].q[1]), masses[0].v);
  }

  /// Checks every few ticks if a pole is near, or has been left.
  Settled settle(const State&, State& y) noexcept {
    // Across a place where r_u and r_v span no plane the parameters carry no velocity, and such a step has no valid result.
    const bool degenerate = met.flat || met.parallel;
    careful = met.oblique || met.longRate || met.besideEnd || (met.thin && !inPolar);
    met = {};
    rounded = !degenerate && careful && roundingShows(y);
    if (degenerate || rounded) return Settled::Lost;
    return ++ticks % kLookEvery != 0 ? Settled::Same : chooseChart(y);
  }
  Settled chooseChart(State& y) noexcept;
  /// From the polar chart back into the parameters of the surface.
  void leavePolar(State& y) noexcept;
  /// The parameters of the surface, in any chart.
  std::array<double, 2> inBase(const State& y) const noexcept { return inPolar ? polar.toBase(y[0], y[1]) : std::array{y[0], y[1]}; }
  /// True if a rounding of u or v changes |r_u| or |r_v|, and so the speed, by more than kShows of it.
  bool roundingShows(const State& y) const noexcept;
  /// True beside a place where r_u and r_v do not span a plane.
  bool lost(const State& y) const noexcept {
    if (endingLine(y) >= 0) return true;
    const constraints::SurfacePoint p = evaluate(active, y[0], y[1]);
    const Vec3 area = cross(p.rU, p.rV);
    return dot(area, area) < 0.25 * 0.25 * largestArea;
  }
  void look(const constraints::SurfacePoint& p) noexcept {
    const double uu = dot(p.rU, p.rU), uv = dot(p.rU, p.rV), vv = dot(p.rV, p.rV), area = uu * vv - uv * uv;
    if (!std::isfinite(area)) return;
    largestU = std::max(largestU, uu);
    largestV = std::max(largestV, vv);
    // A ridge of a typed surface may be very steep. What lies beside it is not degenerate for that.
    constexpr double kSteeper = 1e4;
    largestArea = std::max(largestArea, watch == nullptr || startArea == 0 ? area : std::min(area, kSteeper * startArea));
  }
  /// The pole ahead, where the lines of parameter `fixed` = const collapse, if a pole exists. Newton on r_(other) = 0 along the line finds
  /// it. A check round the whole line confirms it. Where it is still far `waiting` says for how many looks.
  bool findPole(const State& y, int fixed) noexcept;
  bool wantsSubSteps(const State& y, double dt) const noexcept { return careful || (watch != nullptr && !seesWayOf(y, dt)); }
  /// The longest sub-step, at most `most` [s], that misses nothing of the surface.
  double reach(const State& y, const State& dy, double most) const noexcept { return watch == nullptr ? most : reachSeen(y, dy, most); }
  int sightCost() const noexcept { return watch == nullptr ? 0 : kLook; }
  double tightening() const noexcept { return careful ? kTightening : 1; }
  void accelerate(const State& y, const State& dy, std::span<MassState> masses) const noexcept {
    const constraints::SurfacePoint p = constraints::evaluate(active, y[0], y[1]);
    masses[0].a = dy[2] * p.rU + dy[3] * p.rV + (y[2] * y[2]) * p.rUu + (2 * y[2] * y[3]) * p.rUv + (y[3] * y[3]) * p.rVv;
  }

  static bool ends(const constraints::Domain& d) noexcept { return !d.periodic && (std::isfinite(d.lo) || std::isfinite(d.hi)); }
  bool bounded() const noexcept { return ends(domain[0]) || ends(domain[1]) || branches != nullptr; }
  bool bounces() const noexcept { return metLine < 0 && (ends(domain[0]) ? domain[0] : domain[1]).atEnd == constraints::AtEnd::Bounce; }
  bool inside(const State& y) const noexcept {
    if (branches != nullptr && !onBranch(y)) return false;
    if (inPolar) return true;  // left long before another end comes near
    return domain[0].has(y[0]) && domain[1].has(y[1]);
  }
  /// Takes the branch at q. On a line itself it takes the branch to which the rates lead.
  void findBranch(std::span<const double> q, std::span<const double> qRate) noexcept;
  Where branch() const noexcept { return where; }
  void takeBack(const Where& before) noexcept {
    where = before;
    useBranch();
  }
  void useBranch() noexcept {
    if (branches == nullptr) return;
    surface = branches->branches[where.branch];
    if (!inPolar) active = surface;
  }
  bool onBranch(const State& y) const noexcept;
  /// True if the formula has a limit at q on line k. atan2(0, 0) is a number but no limit.
  bool hasLimit(const std::array<double, 2>& q, int k, double alongU, double alongV) const noexcept;
  /// True if the mass may have crossed a line and come back within a step.
  bool turned(const State& from, const State& to, double dt) const noexcept;
  /// Continues the mass behind the line that it crosses. False where it may not pass, or where it met an end of the domain.
  bool passEnds(const State& beyond, State& y, const Hand& hand, double dt) noexcept;
  /// The first line that the mass is beside and that `counts`. Otherwise -1.
  template <class Counts>
  int lineBeside(const State& y, Counts&& counts) const noexcept;
  /// A line at which the formula ends, if the mass is beside it. Otherwise -1.
  int endingLine(const State& y) const noexcept;
  /// True beside a line at which the formula ends or jumps: bounds grow there without limit, and it has its own rules.
  bool besideBlindLine(const State& y) const noexcept;
  std::string stopReason(StepStatus status, const State& y) const;
  /// An elastic edge turns the part of the velocity across it. Where the lines are oblique this part is not the rate of the parameter.
  void meetEnd(const State& beyond, State& y, bool bounce) const noexcept {
    for (int k = 0; k < 2; ++k) {
      const bool low = beyond[k] < domain[k].lo;
      if (domain[k].periodic || (!low && !(beyond[k] > domain[k].hi))) continue;
      y[k] = low ? domain[k].lo : domain[k].hi;
      if (!bounce) continue;
      const constraints::SurfacePoint p = constraints::evaluate(surface, y[0], y[1]);
      const Vec3 along = k == 0 ? p.rV : p.rU, through = k == 0 ? p.rU : p.rV;
      const double oblique = dot(along, through) / dot(along, along), rate = y[2 + k];
      y[2 + k] = low ? std::abs(rate) : -std::abs(rate);
      y[2 + (1 - k)] += oblique * (rate - y[2 + k]);
    }
  }

 private:
  /// A point a little behind the line, because nothing can be computed on a line where the formula has no limit.
  std::array<double, 2> behindTheLines(std::array<double, 2> q) const noexcept;
  /// Carries the mass over line k, a crease. The velocity along the crease stays. The part across it turns into the tangent plane of the
  /// new side. False where r jumps there, or the new side carries no velocity.
  bool crossLine(std::size_t k, const std::array<double, 2>& behind, State& y) noexcept;
  static constexpr int kLook = 24;  // right-hand sides that take the time of a look ahead
  bool seesWayOf(const State& y, double dt) const noexcept;
  double reachSeen(const State& y, const State& dy, double most) const noexcept;
  /// The motion in the parameters of the surface.
  constraints::SurfaceWatch::Motion motionOf(const State& y) const noexcept;
  /// True where a step of dt may pass the pole of the polar chart, at which the parameters of the surface have no rates.
  bool meetsPole(const constraints::SurfaceWatch::Motion& motion, double dt) const noexcept;
  std::string endReason() const;
  std::string lostReason(const State& y) const;
};

}  // namespace reachlab::dynamics
