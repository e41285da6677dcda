#include "constraints/regularity/analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "constraints/constraint.h"

namespace reachlab::constraints {
namespace {

double speedAt(const Constraint& c, double phi) { return norm(evaluate(c.curve, phi).rPhi); }
// Half the slope of |r_phi|^2: changes sign at a minimum, sharply also at a cusp.
double slopeAt(const Constraint& c, double phi) {
  const CurvePoint p = evaluate(c.curve, phi);
  return dot(p.rPhi, p.rPhiPhi);
}

int sampleCount(double lo, double hi) { return static_cast<int>(std::clamp(512 * (hi - lo) / (2 * std::numbers::pi), 2048.0, 200000.0)); }

// Minimum of the speed between two places where the slope is negative and positive.
double bisectSlope(const Constraint& c, double lo, double hi) {
  for (int i = 0; i < 200; ++i) {
    const double middle = lo + (hi - lo) / 2;
    if (middle <= lo || middle >= hi) break;
    (slopeAt(c, middle) < 0 ? lo : hi) = middle;
  }
  return speedAt(c, lo) < speedAt(c, hi) ? lo : hi;
}

}  // namespace

std::array<Domain, 2> boundedDomain(const Constraint& c) {
  std::array<Domain, 2> domain = c.domain;
  const double lo = c.kind == ConstraintKind::Surface ? -1 : 0;
  const double hi = c.kind == ConstraintKind::Surface ? 1 : 2 * std::numbers::pi;
  for (Domain& d : domain) {
    if (std::isinf(d.lo) && std::isinf(d.hi)) d.lo = lo, d.hi = hi;
    if (std::isinf(d.lo)) d.lo = d.hi - (hi - lo);
    if (std::isinf(d.hi)) d.hi = d.lo + (hi - lo);
  }
  return domain;
}

SlowPlace findMinSpeed(const Constraint& c, double from, double to) {
  if (c.kind != ConstraintKind::Curve) throw RefusedError(c.name + " is no curve");
  const double lo = std::min(from, to), hi = std::max(from, to);
  SlowPlace slowest{lo, speedAt(c, lo)};
  const auto look = [&](double phi) {
    if (const double speed = speedAt(c, phi); speed < slowest.speed) slowest = {phi, speed};
  };
  const int n = sampleCount(lo, hi);
  double previous = lo, previousSlope = slopeAt(c, lo);
  for (int i = 1; i <= n; ++i) {
    const double phi = i == n ? hi : lo + (hi - lo) * i / n;
    const double slope = slopeAt(c, phi);
    if (previousSlope < 0 && slope > 0) look(bisectSlope(c, previous, phi));
    else if (slope == 0 && i < n) look(phi);
    previous = phi;
    previousSlope = slope;
  }
  look(hi);
  return slowest;
}

double computeAngleSine(const SurfacePoint& p) noexcept {
  const double sides = norm(p.rU) * norm(p.rV);
  return sides > 0 ? norm(cross(p.rU, p.rV)) / sides : 0;
}

const char* nameOf(DegenerateKind kind) {
  static constexpr const char* kNames[] = {"pole", "apex", "edge", "pinch"};
  return kNames[static_cast<int>(kind)];
}

}  // namespace reachlab::constraints
