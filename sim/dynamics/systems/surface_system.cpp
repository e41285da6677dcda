#include "sim/dynamics/systems/surface_system.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/ticks.h"

namespace reachlab::dynamics {
namespace {

constexpr double kContinuous = 1e-9;                      // of a millimetre and of the surface's size: what counts as no jump
constexpr double kRounding = 1e-12;                       // of |r|, for a surface may lie far away
constexpr double kMargin = 1e-5;                          // of the argument's size
constexpr int kWaitAfterNothing = 16;                     // looks to leave out where there was no pole
constexpr int kWaitForFar = 3;                            // the least where one is not near enough yet
constexpr double kNear = 0.3;                             // of the largest |r_u| (or |r_v|) seen: nearer, a pole is looked for
constexpr double kEnter = 0.4, kLeave = 0.6;              // of a parameter: radius of the polar chart
constexpr double kAside = 0.8;                            // of |r_u|^2: the part across r_uv, which does not shrink
constexpr double kOnePoint = 1e-12, kSameTangent = 1e-9;  // of the largest |r_u| or |r_v|: a pole's line and its tangents
constexpr double kFlatPole = 1e-12;                       // squared sine: the tangents out of a pole span a plane
constexpr double kBeside = 0.05;  // of a parameter, from a line at which the formula ends: r_u may grow without bound
constexpr double kEnding = 0.02;  // of a parameter, from such a line: what stops there stops because of it

/// [m] by how much two limits of r may differ that are one.
double slack(const constraints::SurfacePoint& p) noexcept {
  return kContinuous * (1e-3 + std::fmin(norm(p.r), norm(p.rU) + norm(p.rV))) + kRounding * norm(p.r);
}

}  // namespace

Settled SurfaceSystem::chooseChart(State& y) noexcept {
  if (inPolar) {
    if (y[0] * y[0] + y[1] * y[1] < kLeave * kLeave) return Settled::Same;
    leavePolar(y);
    return Settled::OtherChart;
  }
  const constraints::SurfacePoint p = constraints::evaluate(surface, y[0], y[1]);
  look(p);
  if (waiting > 0) --waiting;
  const double byU = dot(p.rU, p.rU) / largestU, byV = dot(p.rV, p.rV) / largestV;
  if (std::min(byU, byV) >= kNear * kNear || waiting > 0) return Settled::Same;
  const int likely = byU < byV ? 1 : 0;
  waiting = kWaitAfterNothing;
  if (!findPole(y, likely) && !(std::max(byU, byV) < kNear * kNear && findPole(y, 1 - likely))) return Settled::Same;
  const Vec3 v = y[2] * p.rU + y[3] * p.rV;
  const std::array<double, 2> q = polar.toLocal(y[0], y[1]);
  active = polar.surface();
  const std::array<double, 2> rate = solveRates(constraints::evaluate(active, q[0], q[1]), v);
  y.values = {q[0], q[1], rate[0], rate[1]};
  inPolar = true;
  return Settled::OtherChart;
}

void SurfaceSystem::leavePolar(State& y) noexcept {
  const constraints::SurfacePoint local = constraints::evaluate(active, y[0], y[1]);
  const Vec3 v = y[2] * local.rU + y[3] * local.rV;
  const std::array<double, 2> q = polar.toBase(y[0], y[1]);
  const std::array<double, 2> rate = solveRates(constraints::evaluate(surface, q[0], q[1]), v);
  y.values = {q[0], q[1], rate[0], rate[1]};
  active = surface;
  inPolar = false;
}

bool SurfaceSystem::findPole(const State& y, int fixed) noexcept {
  const auto at = [&](double angle, double across) {
    return fixed == 1 ? constraints::evaluate(surface, angle, across) : constraints::evaluate(surface, across, angle);
  };
  const double angle = fixed == 1 ? y[0] : y[1], from = fixed == 1 ? y[1] : y[0];
  double across = from;
  for (int round = 0; round < 12; ++round) {
    const constraints::SurfacePoint p = at(angle, across);
    const Vec3 along = fixed == 1 ? p.rU : p.rV;
    const double change = dot(along, p.rUv) / dot(p.rUv, p.rUv);
    // Towards a pole the whole of r_(other) shrinks along r_uv.
    if (round == 0 && dot(along, along) - change * dot(along, p.rUv) > kAside * dot(along, along)) {
      waiting = kWaitForFar;
      return false;
    }
    if (!std::isfinite(change)) break;
    across -= change;
    if (std::abs(change) < 1e-16 * std::abs(across)) break;
  }
  if (!std::isfinite(across) || across == from) return false;
  if (const double away = std::abs(across - from) - kEnter; away > 0) {
    // Half of the looks in which the mass could be near enough.
    const double looks = 0.5 * away / (kLookEvery * kTickSeconds * std::abs(fixed == 1 ? y[3] : y[2]));
    if (looks < waiting) waiting = std::max(kWaitForFar, static_cast<int>(looks));
    return false;
  }
  // A pole: the whole line is one point, and the tangents out of it are A cos(k angle) + B sin(k angle). It winds k times in 2 pi.
  const double largest = std::sqrt(std::max(largestU, largestV)), reach = 0.1 * (from - across);
  const constraints::SurfacePoint pole = at(angle, across);
  const Vec3 out = fixed == 1 ? pole.rV : pole.rU, turn = pole.rUv;
  const double oo = dot(out, out), ot = dot(out, turn), tt = dot(turn, turn), determinant = oo * tt - ot * ot;
  if (!(determinant > kFlatPole * oo * tt)) return false;
  const auto phaseAt = [&](double by, double winding) {  // NaN where the tangents are not of that form
    const constraints::SurfacePoint p = at(angle + by, across);
    const Vec3 there = fixed == 1 ? p.rV : p.rU;
    const double a = dot(there, out), b = dot(there, turn), c = (a * tt - b * ot) / determinant, s = (b * oo - a * ot) / determinant;
    if (norm(p.r - pole.r) > kOnePoint * largest || norm(there - c * out - s * turn) > kSameTangent * largest) return std::nan("");
    return std::atan2(winding * s, c);
  };
  constexpr double kFirst = 0.04, kLast = 8;
  constexpr double kMost = 64;
  const constraints::SurfacePoint aside = at(angle + kFirst, across);
  const Vec3 there = fixed == 1 ? aside.rV : aside.rU;
  double winding = std::acos(std::clamp((dot(there, out) * tt - dot(there, turn) * ot) / determinant, -1.0, 1.0)) / kFirst;
  for (double by = kFirst; by < kLast; by *= 2) {
    const double turns = std::nearbyint((winding * by - phaseAt(by, winding)) / (2 * std::numbers::pi));
    winding = (phaseAt(by, winding) + 2 * std::numbers::pi * turns) / by;
  }
  if (const double whole = std::nearbyint(winding); std::abs(winding - whole) < 1e-12 * kMost) winding = whole;
  if (!(winding > 1 / kMost && winding < kMost)) return false;
  for (int i = 0; i < 3; ++i) {
    const double beside = angle + 2.1 * i / winding;
    if (!(norm(at(beside + 2 * std::numbers::pi / winding, across + reach).r - at(beside, across + reach).r) <= kOnePoint * largest))
      return false;
  }
  polar = {surface, fixed, across, from > across ? 1.0 : -1.0, winding};
  return true;
}

void SurfaceSystem::findBranch(std::span<const double> q, std::span<const double> qRate) noexcept {
  const auto lines = branches->at(q[0], q[1]);
  where = {};
  for (std::size_t k = 0; k < branches->lines.size(); ++k) {
    double value = lines[k].value;
    if (value == 0) value = lines[k].u * qRate[0] + lines[k].v * qRate[1];
    where.side[k] = value < 0 ? -1 : 1;
    const double typical = std::max(std::abs(value), 0.1 * (std::abs(lines[k].u) + std::abs(lines[k].v)));
    margin[k] = branches->lines[k].passable ? 0 : kMargin * typical;
    if (const int bit = branches->lines[k].bit; bit >= 0 && where.side[k] > 0) where.branch |= 1 << bit;
  }
  useBranch();
}

bool SurfaceSystem::onBranch(const State& y) const noexcept {
  const std::array<double, 2> q = inBase(y);
  const auto lines = branches->at(q[0], q[1]);
  for (std::size_t k = 0; k < branches->lines.size(); ++k) {
    const double inwards = lines[k].value * where.side[k];
    if (!(inwards >= margin[k])) return false;
    if (inwards == 0 && !hasLimit(q, static_cast<int>(k), lines[k].u, lines[k].v)) return false;
    met.besideEnd = met.besideEnd || (!branches->lines[k].passable && inwards < kBeside * (std::abs(lines[k].u) + std::abs(lines[k].v)));
  }
  return true;
}

bool SurfaceSystem::hasLimit(const std::array<double, 2>& q, int k, double alongU, double alongV) const noexcept {
  constexpr double kStep = 1e-7, kSame = 1e-4;  // of the parameters, and of a derivative's size
  const constraints::SurfacePoint here = evaluate(surface, q[0], q[1]);
  if (!isFinite(here.r) || !isFinite(here.rU) || !isFinite(here.rV)) return false;
  const double steep = std::hypot(alongU, alongV);
  if (!(steep > 0)) return true;
  const double step = kStep * where.side[k] / steep, du = step * alongU, dv = step * alongV;
  const constraints::SurfacePoint beside = evaluate(surface, q[0] + du, q[1] + dv);
  return norm(beside.r - du * beside.rU - dv * beside.rV - here.r) <= slack(here) &&
         norm(here.rU - beside.rU) + norm(here.rV - beside.rV) <= kSame * (norm(beside.rU) + norm(beside.rV));
}

bool SurfaceSystem::turned(const State& from, const State& to, double dt) const noexcept {
  if (branches == nullptr || inPolar) return false;
  const auto a = branches->at(from[0], from[1]), b = branches->at(to[0], to[1]);
  for (std::size_t k = 0; k < branches->lines.size(); ++k) {
    const double before = (a[k].u * from[2] + a[k].v * from[3]) * where.side[k], after = (b[k].u * to[2] + b[k].v * to[3]) * where.side[k];
    if (before < 0 && after > 0 && std::fmin(a[k].value, b[k].value) * where.side[k] < -before * dt) return true;
  }
  return false;
}

bool SurfaceSystem::passEnds(const State& beyond, State& y, const Hand&, double) noexcept {
  if (branches == nullptr) return false;
  const std::array<double, 2> behind = behindTheLines(inBase(beyond));
  const auto lines = branches->at(behind[0], behind[1]);
  bool passed = false;
  for (std::size_t k = 0; k < branches->lines.size(); ++k) {
    if (lines[k].value * where.side[k] >= margin[k]) continue;
    metLine = static_cast<int>(k);
    if (!branches->lines[k].passable) return false;
    if (inPolar) leavePolar(y);
    if (!crossLine(k, behind, y)) return false;
    metLine = -1;
    passed = true;
  }
  return passed;
}

std::array<double, 2> SurfaceSystem::behindTheLines(std::array<double, 2> q) const noexcept {
  constexpr double kBehind = 1e-12;  // of the parameters
  const auto lines = branches->at(q[0], q[1]);
  for (std::size_t k = 0; k < branches->lines.size(); ++k) {
    const double steep = std::hypot(lines[k].u, lines[k].v);
    if (lines[k].value != 0 || !(steep > 0) || hasLimit(q, static_cast<int>(k), lines[k].u, lines[k].v)) continue;
    const double step = kBehind * std::fmax(1, std::hypot(q[0], q[1])) * where.side[k] / steep;
    q = {q[0] - step * lines[k].u, q[1] - step * lines[k].v};
  }
  return q;
}

bool SurfaceSystem::crossLine(std::size_t k, const std::array<double, 2>& behind, State& y) noexcept {
  const Where other{where.branch ^ (1 << branches->lines[k].bit), where.side};
  const constraints::SurfacePoint here = evaluate(surface, y[0], y[1]);
  // Just behind the line: before it the other branch may have a value that it has not got there (atan2(u, u)).
  const constraints::SurfacePoint there = evaluate(branches->branches[other.branch], behind[0], behind[1]);
  if (!(norm(here.r - there.r) <= slack(here))) return false;
  const auto line = branches->at(behind[0], behind[1])[k];
  // Unit vectors along the crease and across it, the latter in each side's tangent plane.
  const auto across = [&](const constraints::SurfacePoint& p, const Vec3& along) {
    const Vec3 through = line.u * p.rU + line.v * p.rV, part = through - dot(through, along) * along;
    return part / norm(part);
  };
  Vec3 along = line.u * here.rV - line.v * here.rU;
  along = along / norm(along);
  const Vec3 v = y[2] * here.rU + y[3] * here.rV;
  const Vec3 turnedVelocity = dot(v, along) * along + dot(v, across(here, along)) * across(there, along);
  const std::array<double, 2> rate = solveRates(there, turnedVelocity);
  if (!std::isfinite(rate[0]) || !std::isfinite(rate[1])) return false;
  y.values = {behind[0], behind[1], rate[0], rate[1]};
  where = other;
  where.side[k] = static_cast<signed char>(-where.side[k]);
  useBranch();
  return true;
}

bool SurfaceSystem::roundingShows(const State& y) const noexcept {
  constexpr double kRounded = std::numeric_limits<double>::epsilon();
  const constraints::SurfacePoint p = evaluate(active, y[0], y[1]);
  const double byU = norm(p.rUu) / norm(p.rU) + norm(p.rUv) / norm(p.rV), byV = norm(p.rUv) / norm(p.rU) + norm(p.rVv) / norm(p.rV);
  return !(kRounded * (std::abs(y[0]) * byU + std::abs(y[1]) * byV) <= kShows);
}

constraints::SurfaceWatch::Motion SurfaceSystem::motionOf(const State& y) const noexcept {
  constraints::SurfaceWatch::Motion motion;
  motion.q = inBase(y);
  const constraints::SurfacePoint here = evaluate(active, y[0], y[1]);
  const Vec3 velocity = y[2] * here.rU + y[3] * here.rV;
  motion.speed = norm(velocity);
  const constraints::SurfacePoint p = inPolar ? evaluate(surface, motion.q[0], motion.q[1]) : here;
  motion.rate = inPolar ? solveRates(p, velocity) : std::array{y[2], y[3]};
  motion.length = {norm(p.rU), norm(p.rV)};
  return motion;
}

bool SurfaceSystem::meetsPole(const constraints::SurfaceWatch::Motion& motion, double dt) const noexcept {
  constexpr double kSteps = 4;  // from the pole, in its parameter
  if (!inPolar) return false;
  const std::size_t across = polar.fixed == 1 ? 1 : 0;
  return !(std::abs(motion.q[across] - polar.pole) * motion.length[across] > kSteps * dt * motion.speed);
}

bool SurfaceSystem::seesWayOf(const State& y, double dt) const noexcept {
  if (!inPolar && watch->knows({y[0], y[1]}, {y[2], y[3]}, dt)) return true;
  if (besideBlindLine(y)) return true;
  const constraints::SurfaceWatch::Motion motion = motionOf(y);
  return meetsPole(motion, dt) || watch->allows(motion, dt);
}

double SurfaceSystem::reachSeen(const State& y, const State& dy, double most) const noexcept {
  constexpr double kToApex = 0.4;  // of the way to a place where r_u or r_v vanishes
  if (besideBlindLine(y)) return most;
  constraints::SurfaceWatch::Motion motion = motionOf(y);
  if (inPolar) return meetsPole(motion, most) ? most : watch->reach(motion, most);
  motion.acceleration = {dy[2], dy[3]};
  const constraints::SurfacePoint p = evaluate(active, y[0], y[1]);
  const double area = dot(cross(p.rU, p.rV), cross(p.rU, p.rV));
  if (area < kThin * largestArea) {
    const double u = norm(y[2] * p.rUu + y[3] * p.rUv), v = norm(y[2] * p.rUv + y[3] * p.rVv);
    most = std::min({most, u > 0 ? kToApex * norm(p.rU) / u : most, v > 0 ? kToApex * norm(p.rV) / v : most});
  }
  return watch->reach(motion, most);
}

template <class Counts>
int SurfaceSystem::lineBeside(const State& y, Counts&& counts) const noexcept {
  if (branches == nullptr) return -1;
  const std::array<double, 2> q = inBase(y);
  const auto lines = branches->at(q[0], q[1]);
  for (std::size_t k = 0; k < branches->lines.size(); ++k)
    if (counts(branches->lines[k]) && !(std::abs(lines[k].value) > kEnding * (std::abs(lines[k].u) + std::abs(lines[k].v))))
      return static_cast<int>(k);
  return -1;
}

int SurfaceSystem::endingLine(const State& y) const noexcept {
  return lineBeside(y, [](const constraints::SurfaceBranches::Line& line) { return !line.passable; });
}

bool SurfaceSystem::besideBlindLine(const State& y) const noexcept {
  return lineBeside(y, [](const auto& line) { return !line.passable || line.kind == constraints::PlaceKind::Jump; }) >= 0;
}

std::string SurfaceSystem::stopReason(StepStatus status, const State& y) const {
  if (status == StepStatus::AtEnd) return endReason();
  return status == StepStatus::NoContinuation ? lostReason(y) : "";
}

std::string SurfaceSystem::endReason() const {
  if (metLine < 0) return "the mass reached the end of the constraint's domain";
  const constraints::SurfaceBranches::Line& line = branches->lines[metLine];
  if (line.passable)
    return fmt::format("the mass met a place of the surface that is never crossed: {}: {}", nameOf(constraints::PlaceKind::Jump),
                       line.because);
  return fmt::format(
      "the mass is beside a place of the surface that is never crossed: {}: {} (its argument is {:.2g} from {:g}; nearer, the formula loses "
      "the digits of the speed)",
      nameOf(line.kind), line.because, margin[metLine], line.level);
}

std::string SurfaceSystem::lostReason(const State& y) const {
  const int k = endingLine(y);
  if (k < 0) {
    const constraints::SurfacePoint p = evaluate(active, y[0], y[1]);
    const Vec3 area = cross(p.rU, p.rV);
    constexpr double kSeenParallel = 1e-4;  // squared sine: within 0.6 degrees the lines explain the stop
    if (dot(area, area) < kSeenParallel * dot(p.rU, p.rU) * dot(p.rV, p.rV))
      return fmt::format(
          "the surface's parameter lines run into each other here: r_u and r_v are {:.2g} degrees apart, too little for a "
          "velocity to be told from its rates; write the surface in other parameters",
          std::sqrt(dot(area, area) / (dot(p.rU, p.rU) * dot(p.rV, p.rV))) * 180 / std::numbers::pi);
    if (rounded || roundingShows(y))
      return fmt::format(
          "the surface is so steep in its parameters here (|r_u| {:.2g} m, |r_v| {:.2g} m) that their rounding shows in the speed; write the "
          "surface in other parameters",
          norm(p.rU), norm(p.rV));
    if (startArea > 0 && largestArea > 100 * startArea && dot(area, area) > kDegenerate * startArea)
      return fmt::format(
          "the surface was so steep in its parameters on the way (|r_u x r_v| {:.2g} m^2, here {:.2g} m^2) that the accuracy cannot be held; "
          "write the surface in other parameters",
          std::sqrt(largestArea), norm(area));
    return "the surface degenerates here (a pinch point, an apex or a cuspidal edge): there is no unique continuation";
  }
  const constraints::SurfaceBranches::Line& line = branches->lines[k];
  return fmt::format("the mass is beside a place of the surface that is never crossed: {}: {}", nameOf(line.kind), line.because);
}

}  // namespace reachlab::dynamics
