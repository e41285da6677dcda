#pragma once
#include <vector>

#include "base/math/vec3.h"

namespace reachlab {

/// How a spline ends: with no curvature (natural: a hand that was at rest before and is after), or with the third derivative continuous at
/// the second and last but one points (not-a-knot: samples of a smooth motion that goes on). Fewer than four points of the second kind: the
/// polynomial through them.
enum class SplineEnds { Natural, NotAKnot };

/// C2 cubic through (time, value) (de Boor, A Practical Guide to Splines, ch. IV). A value; any thread.
class CubicSpline {
 public:
  /// At least one point, times strictly increasing, as many values.
  CubicSpline(std::vector<double> time, std::vector<Vec3> value, SplineEnds ends);
  struct Point {
    Vec3 value, rate;
  };
  /// At the first and last time the rate is the inner one; beyond them the value is held with zero rate.
  Point at(double t) const;

 private:
  std::vector<double> time_;
  std::vector<Vec3> value_, bend_;  // bend: the second derivative at the points
};

}  // namespace reachlab
