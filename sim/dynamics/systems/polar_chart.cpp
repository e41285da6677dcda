#include "sim/dynamics/systems/polar_chart.h"

#include <cmath>

#include "base/math/elementary.h"

namespace reachlab::dynamics {

std::array<double, 2> PolarChart::toLocal(double u, double v) const noexcept {
  const double angle = winding * (fixed == 1 ? u : v), radius = side * ((fixed == 1 ? v : u) - pole);
  return {radius * elementary::cos(angle), radius * elementary::sin(angle)};
}

std::array<double, 2> PolarChart::toBase(double xi, double eta) const noexcept {
  const double angle = elementary::atan2(eta, xi) / winding, across = pole + side * std::hypot(xi, eta);
  return fixed == 1 ? std::array{angle, across} : std::array{across, angle};
}

void PolarChart::evaluateChart(const void* chart, const double*, double xi, double eta, constraints::SurfacePoint& out) noexcept {
  const PolarChart& c = *static_cast<const PolarChart*>(chart);
  double rho = std::hypot(xi, eta);
  const double x0 = xi, y0 = eta;
  const bool close = rho < c.nearest;
  if (close) {
    const double angle = elementary::atan2(eta, xi);
    rho = c.nearest;
    xi = rho * elementary::cos(angle);
    eta = rho * elementary::sin(angle);
  }
  const std::array<double, 2> q = c.toBase(xi, eta);
  constraints::SurfacePoint p = constraints::evaluate(c.base, q[0], q[1]);
  if (c.fixed == 0) {  // u is the radius: name the angle u
    std::swap(p.rU, p.rV);
    std::swap(p.rUu, p.rVv);
  }
  const double turn = 1 / c.winding;  // from now on by the angle itself
  p.rU *= turn;
  p.rUv *= turn;
  p.rUu *= turn * turn;
  const double r2 = rho * rho, s = c.side;
  const double ax = -eta / r2, ay = xi / r2, rx = xi / rho, ry = eta / rho;  // first derivatives of angle and radius
  const double axx = 2 * xi * eta / (r2 * r2), axy = (eta * eta - xi * xi) / (r2 * r2);
  const double rxx = eta * eta / (r2 * rho), ryy = xi * xi / (r2 * rho), rxy = -xi * eta / (r2 * rho);
  out.r = p.r;
  out.rU = ax * p.rU + (s * rx) * p.rV;
  out.rV = ay * p.rU + (s * ry) * p.rV;
  out.rUu = (ax * ax) * p.rUu + (2 * s * ax * rx) * p.rUv + (rx * rx) * p.rVv + axx * p.rU + (s * rxx) * p.rV;
  out.rVv = (ay * ay) * p.rUu + (2 * s * ay * ry) * p.rUv + (ry * ry) * p.rVv - axx * p.rU + (s * ryy) * p.rV;
  out.rUv = (ax * ay) * p.rUu + (s * (ax * ry + ay * rx)) * p.rUv + (rx * ry) * p.rVv + axy * p.rU + (s * rxy) * p.rV;
  if (close) out.r += (x0 - xi) * out.rU + (y0 - eta) * out.rV;
}

}  // namespace reachlab::dynamics
