#include "sim/dynamics/surface_system.h"

#include <numbers>

namespace reachlab::dynamics {
namespace {

constexpr int kWaitAfterNothing = 16;         // looks to leave out where there was none
constexpr double kNear = 0.3;                 // of the largest |r_u| (or |r_v|) seen
constexpr double kEnter = 0.4, kLeave = 0.6;  // radius of the polar chart

}  // namespace

Settled SurfaceSystem::chooseChart(State& y) noexcept {
  if (inPolar) {
    if (y[0] * y[0] + y[1] * y[1] < kLeave * kLeave) return Settled::Same;
    const constraints::SurfacePoint local = constraints::evaluate(active, y[0], y[1]);
    const Vec3 v = y[2] * local.rU + y[3] * local.rV;
    const std::array<double, 2> q = polar.toBase(y[0], y[1]);
    const std::array<double, 2> rate = solveRates(constraints::evaluate(surface, q[0], q[1]), v);
    y.values = {q[0], q[1], rate[0], rate[1]};
    active = surface;
    inPolar = false;
    return Settled::OtherChart;
  }
  const constraints::SurfacePoint p = constraints::evaluate(surface, y[0], y[1]);
  look(p);
  if (waiting > 0) --waiting;
  const int fixed = dot(p.rU, p.rU) < kNear * kNear * largestU ? 1 : dot(p.rV, p.rV) < kNear * kNear * largestV ? 0 : -1;
  if (fixed < 0 || waiting > 0) return Settled::Same;
  if (!findPole(y, fixed)) {
    waiting = kWaitAfterNothing;
    return Settled::Same;
  }
  const Vec3 v = y[2] * p.rU + y[3] * p.rV;
  const std::array<double, 2> q = polar.toLocal(y[0], y[1]);
  active = polar.surface();
  const std::array<double, 2> rate = solveRates(constraints::evaluate(active, q[0], q[1]), v);
  y.values = {q[0], q[1], rate[0], rate[1]};
  inPolar = true;
  return Settled::OtherChart;
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
    if (!std::isfinite(change)) break;
    across -= change;
    if (std::abs(change) < 1e-16 * std::abs(across)) break;
  }
  if (!std::isfinite(across) || std::abs(across - from) > kEnter || across == from) return false;
  // A pole: the whole line is one point, 2 pi is a period, and opposite sides continue each other.
  const double largest = std::sqrt(std::max(largestU, largestV)), reach = 0.1 * (from - across);
  const constraints::SurfacePoint pole = at(angle, across), beside = at(angle, across + reach),
                                  again = at(angle + 2 * std::numbers::pi, across + reach);
  if (norm(again.r - beside.r) > 1e-12 * largest) return false;
  for (int i = 0; i < 8; ++i) {
    const constraints::SurfacePoint a = at(angle + 0.25 * std::numbers::pi * i, across),
                                    b = at(angle + 0.25 * std::numbers::pi * i + std::numbers::pi, across);
    const Vec3 outA = fixed == 1 ? a.rV : a.rU, outB = fixed == 1 ? b.rV : b.rU;
    if (norm(a.r - pole.r) > 1e-12 * largest || norm(outA + outB) > 1e-9 * largest) return false;
  }
  polar = {surface, fixed, across, from > across ? 1.0 : -1.0};
  return true;
}

}  // namespace reachlab::dynamics
