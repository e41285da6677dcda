#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "base/math/lanes.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Positions as power series, interval by interval: on interval p, s = t/width - p - centre, output i is sum_k c_k s^k [m]. Eight intervals
/// lie side by side in the lanes of a batch.
struct PiecewiseSeries {
  PiecewiseSeries() = default;
  PiecewiseSeries(int outputCount, int termCount, int intervalCount)
      : outputs(outputCount), terms(termCount), intervals(intervalCount),
        coefficient(static_cast<size_t>(lanesFor<kBatchLanes>(intervals)) * outputs * terms) {}

  int outputs = 0, terms = 0, intervals = 0;
  double width = 0;                    // [s]
  double centre = 0;                   // where in an interval s is 0: 0 its beginning, 0.5 its middle
  std::vector<LaneBatch> coefficient;  // [batch of intervals][output][term]

  /// The terms of one output in the batch with this interval, which has the lane interval % kBatchLanes.
  LaneBatch* of(int interval, int output) { return &coefficient[(static_cast<size_t>(interval / kBatchLanes) * outputs + output) * terms]; }
  const LaneBatch* of(int interval, int output) const { return const_cast<PiecewiseSeries*>(this)->of(interval, output); }
  /// Position, velocity and acceleration of one output at t in [0, T].
  PredictedHand evaluate(int output, double t) const;
  /// Velocities of one output at as many times as there are places, equally spaced from 0 to `end`, at most T.
  void sampleVelocity(int output, double end, std::span<double> velocity) const;
};

}  // namespace reachlab::predict
