#pragma once
#include "constraints/constraint.h"

namespace reachlab::dynamics {

/// A local chart about a pole of a surface r(u, v), where a whole parameter line is one point. The parameter along this line is the angle.
/// The distance of the second parameter from the pole is the radius, (xi, eta) = radius (cos angle, sin angle). In xi, eta the surface is
/// smooth there and its equations of motion are those of any other chart. A line may wind
/// several times round the pole while its parameter runs through 2 pi. Then `winding` times the parameter is the angle.
struct PolarChart {
  constraints::Surface base;
  int fixed = 1;          // which parameter is constant on the pole's line
  double pole = 0;        // its value there
  double side = 1;        // +1: the surface lies at larger values
  double winding = 1;     // more than 0
  double nearest = 1e-6;  // closer, the derivatives are taken at this radius: rounding would grow like 1/radius

  /// The chart as a surface. `this` must outlive the surface.
  constraints::Surface surface() const noexcept { return {evaluateChart, this, {}}; }
  std::array<double, 2> toLocal(double u, double v) const noexcept;
  std::array<double, 2> toBase(double xi, double eta) const noexcept;

 private:
  static void evaluateChart(const void* chart, const double* shape, double xi, double eta, constraints::SurfacePoint& out) noexcept;
};

}  // namespace reachlab::dynamics
