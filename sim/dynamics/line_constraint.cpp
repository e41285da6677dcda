#include "sim/dynamics/line_constraint.h"

#include <numbers>

namespace reachlab {
namespace {

void evaluateLine(const void*, const double* shape, double phi, CurvePoint& out) noexcept {
  const double slope = shape[0] / (2 * std::numbers::pi);
  out = {{-shape[0] / 2 + phi * slope, 0, 0}, {slope, 0, 0}, {}};
}

}  // namespace

Constraint makeLine(const ConstraintSpec& spec) {
  const auto length = spec.shape.find("length_m");
  Constraint line;
  line.kind = ConstraintKind::Curve;
  line.name = "line";
  line.curve.function = evaluateLine;
  line.curve.shape[0] = length == spec.shape.end() ? 0.2 : length->second;
  line.straight = true;
  return line;
}

}  // namespace reachlab
