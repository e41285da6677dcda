#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "sim/predict/prediction.h"

namespace reachlab::predict {

/// Positions as power series, interval by interval: on interval p, s = t/width - p - centre, output i is sum_k c_k s^k [m].
struct PiecewiseSeries {
  int outputs = 0, terms = 0, intervals = 0;
  double width = 0;                 // [s]
  double centre = 0;                // where in a interval s is 0: 0 its beginning, 0.5 its middle
  std::vector<double> coefficient;  // [interval][output][term]

  const double* of(int interval, int output) const { return &coefficient[(static_cast<size_t>(interval) * outputs + output) * terms]; }
  /// Position, velocity and acceleration of one output at t in [0, T].
  PredictedHand evaluate(int output, double t) const;
  /// Velocities of one output at as many times as there are places, equally spaced from 0 to `end`, at most T.
  void sampleVelocity(int output, double end, std::span<double> velocity) const;
};

}  // namespace reachlab::predict
