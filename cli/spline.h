#pragma once
#include <vector>

namespace reachlab::cli {

/// Cubic spline through (t_i, x_i) with two continuous derivatives and not-a-knot ends (fewer than four points: the polynomial through
/// them). At the first and last time the rate is the inner one; beyond them the value is held with zero rate.
class Spline {
 public:
  /// Times strictly increasing, as many values.
  Spline(std::vector<double> times, std::vector<double> values);
  struct Value {
    double x = 0, rate = 0;
  };
  Value at(double t) const;

 private:
  std::vector<double> t_, x_, second_;  // second derivatives at the points
};

}  // namespace reachlab::cli
