#pragma once
#include <cstddef>
#include <vector>

#include "sim/predict/predict.h"

namespace reachlab {

/// Positions as power series, panel by panel: on panel p, s = t/width - p in [0, 1], output i is sum_k c_k s^k [m].
struct SeriesProfile {
  int outputs = 0, terms = 0, panels = 0;
  double width = 0;                 // [s]
  std::vector<double> coefficient;  // [panel][output][term]

  const double* of(int panel, int output) const { return &coefficient[(static_cast<size_t>(panel) * outputs + output) * terms]; }
  /// Position, velocity and acceleration of one output at t in [0, T].
  PredictedHand evaluate(int output, double t) const;
};

}  // namespace reachlab
