#pragma once
#include <vector>

#include "base/vec3.h"

namespace reachlab::devices {

/// C2 cubic through (time, value) with zero second derivative at both ends (de Boor, A Practical Guide to Splines, ch. IV). Two points
/// give a straight line. Times strictly increase.
class NaturalSpline {
 public:
  NaturalSpline(std::vector<double> time, std::vector<Vec3> value);
  /// Within [first, last] time.
  Vec3 at(double t) const;

 private:
  std::vector<double> time_;
  std::vector<Vec3> value_, bend_;  // bend: the second derivative at the knots
};

}  // namespace reachlab::devices
