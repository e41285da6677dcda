#include "sim/dynamics/systems/quadric_system.h"

#include <algorithm>

namespace reachlab::dynamics {

void QuadricSystem::follow(const Vec3& r) const noexcept {
  const auto newton = [&](std::array<double, 2> q) {
    for (int round = 0; round < 20; ++round) {
      const constraints::SurfacePoint p = constraints::evaluate(surface, q[0], q[1]);
      const std::array<double, 2> step = solveRates(p, r - p.r);
      const double limit = std::min(1.0, 0.5 / std::max(std::abs(step[0]), std::abs(step[1])));
      q[0] += limit * step[0];
      q[1] += limit * step[1];
      const double size = 1 + std::abs(q[0]) + std::abs(q[1]);
      if (std::abs(step[0]) + std::abs(step[1]) < 1e-15 * size) break;
    }
    return q;
  };
  const auto distance = [&](const std::array<double, 2>& q) {
    const double d = norm(constraints::evaluate(surface, q[0], q[1]).r - r);
    return std::isfinite(d) ? d : 1e300;
  };
  const double close = 1e-9 * (1 + norm(r));
  std::array<double, 2> found = newton(parameters);
  if (distance(found) > close) {
    constexpr int kAcross = 32;
    std::array<double, 2> lo, width, best = parameters;
    for (int k = 0; k < 2; ++k) {
      lo[k] = std::isfinite(domain[k].lo) ? domain[k].lo : parameters[k] - 3.2;
      width[k] = (std::isfinite(domain[k].hi) ? domain[k].hi : parameters[k] + 3.2) - lo[k];
    }
    double nearest = distance(best);
    for (int i = 0; i < kAcross * kAcross; ++i) {
      const std::array q{lo[0] + width[0] * (i % kAcross + 0.5) / kAcross, lo[1] + width[1] * (i / kAcross + 0.5) / kAcross};
      if (const double d = distance(q); d < nearest) nearest = d, best = q;
    }
    found = newton(best);
  }
  if (distance(found) <= close) parameters = found;
}

void QuadricSystem::meetEnd(const State& beyond, State& y, bool bounce) const noexcept {
  follow({beyond[0], beyond[1], beyond[2]});
  const std::array<double, 2> outside = parameters;
  follow({y[0], y[1], y[2]});
  for (int k = 0; k < 2; ++k) {
    const bool low = outside[k] < domain[k].lo;
    if (domain[k].periodic || (!low && !(outside[k] > domain[k].hi))) continue;
    parameters[k] = low ? domain[k].lo : domain[k].hi;
    const constraints::SurfacePoint p = constraints::evaluate(surface, parameters[0], parameters[1]);
    Vec3 v{y[3], y[4], y[5]};
    if (bounce) {
      const Vec3 edge = k == 0 ? p.rV : p.rU, through = k == 0 ? p.rU : p.rV;
      const Vec3 across = through - (dot(through, edge) / dot(edge, edge)) * edge;
      const double part = dot(v, across);
      if (low ? part < 0 : part > 0) v -= (2 * part / dot(across, across)) * across;
    }
    y.assign(p.r.x, p.r.y, p.r.z, v.x, v.y, v.z);
  }
}

}  // namespace reachlab::dynamics
