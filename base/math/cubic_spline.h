#pragma once
#include <vector>

#include "base/math/vec3.h"

namespace reachlab {

/// The condition at the ends of a spline. Natural: no curvature, for a hand that rests before and after. Not-a-knot: the third derivative
/// is continuous at the second point and the last but one, for samples of a smooth motion that continues. With fewer than four points,
/// not-a-knot gives the polynomial through them.
enum class SplineEnds { Natural, NotAKnot };

/// C2 cubic through (time, value) (de Boor, A Practical Guide to Splines, ch. IV). A value. Any thread.
class CubicSpline {
 public:
  /// At least one point, times strictly increasing, as many values.
  CubicSpline(std::vector<double> time, std::vector<Vec3> value, SplineEnds ends);
  struct Point {
    Vec3 value, rate;
  };
  /// At the first and last time the rate is the rate inside. Beyond them the value is held with zero rate.
  Point at(double t) const;

 private:
  std::vector<double> time_;
  std::vector<Vec3> value_, bend_;  // bend: the second derivative at the points
};

}  // namespace reachlab
