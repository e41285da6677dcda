#include "sim/predict/numerics/piecewise_series.h"

#include <algorithm>
#include <array>

#include "sim/predict/numerics/wide_lanes.h"

namespace reachlab::predict {

PredictedHand PiecewiseSeries::evaluate(int output, double t) const {
  const double x = t / width;
  const int interval = std::clamp(static_cast<int>(x), 0, intervals - 1);
  const double s = x - interval - centre;
  const LaneBatch* c = of(interval, output);
  const int lane = interval % kBatchLanes;
  double position = 0, slope = 0, curvature = 0;  // Horner with two derivatives
  for (int k = terms; k-- > 0;) {
    curvature = curvature * s + slope;
    slope = slope * s + position;
    position = position * s + c[k][lane];
  }
  return {position, slope / width, 2 * curvature / (width * width)};
}

void PiecewiseSeries::sampleVelocity(int output, double end, std::span<double> velocity) const {
  const double step = end / width / static_cast<double>(velocity.size() - 1);
  const auto intervalOf = [&](size_t sample) { return std::clamp(static_cast<int>(step * static_cast<double>(sample)), 0, intervals - 1); };
  size_t done = 0;
  for (int first = 0; first < intervals; first += kBatchLanes) {  // each lane takes the samples of its own interval
    std::array<size_t, kBatchLanes> next{}, last{};
    for (int lane = 0; lane < kBatchLanes; ++lane) {
      next[lane] = done;
      while (done < velocity.size() && intervalOf(done) == first + lane) ++done;
      last[lane] = done;
    }
    const LaneBatch* c = of(first, output);
    while (next != last) {
      LaneBatch s{}, slope{};
      for (int lane = 0; lane < kBatchLanes; ++lane) s[lane] = step * static_cast<double>(next[lane]) - (first + lane) - centre;
      for (int k = terms - 1; k > 0; --k) slope = mulAdd(slope, s, k * c[k]);
      for (int lane = 0; lane < kBatchLanes; ++lane)
        if (next[lane] < last[lane]) velocity[next[lane]++] = slope[lane] / width;
    }
  }
}

}  // namespace reachlab::predict
