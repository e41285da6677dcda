#include "sim/predict/numerics/piecewise_series.h"

#include <algorithm>

#include "sim/predict/numerics/wide_lanes.h"

namespace reachlab::predict {

PredictedHand PiecewiseSeries::evaluate(int output, double t) const {
  const double x = t / width;
  const int interval = std::clamp(static_cast<int>(x), 0, intervals - 1);
  const double s = x - interval - centre;
  const double* c = of(interval, output);
  double position = 0, slope = 0, curvature = 0;  // Horner with two derivatives
  for (int k = terms; k-- > 0;) {
    curvature = curvature * s + slope;
    slope = slope * s + position;
    position = position * s + c[k];
  }
  return {position, slope / width, 2 * curvature / (width * width)};
}

void PiecewiseSeries::sampleVelocity(int output, double end, std::span<double> velocity) const {
  const auto intervalOf = [&](double x) { return std::clamp(static_cast<int>(x), 0, intervals - 1); };
  const double step = end / width / static_cast<double>(velocity.size() - 1);
  for (size_t done = 0; done < velocity.size();) {  // as many of a interval as a batch holds, side by side
    const int interval = intervalOf(step * static_cast<double>(done));
    LaneBatch s{}, position{}, slope{};
    int count = 0;
    for (; count < kBatchLanes && done + count < velocity.size(); ++count) {
      const double x = step * static_cast<double>(done + count);
      if (intervalOf(x) != interval) break;
      s[count] = x - interval - centre;
    }
    const double* c = of(interval, output);
    for (int k = terms; k-- > 0;) {
      slope = slope * s + position;
      position = position * s + c[k];
    }
    for (int i = 0; i < count; ++i) velocity[done + i] = slope[i] / width;
    done += static_cast<size_t>(count);
  }
}

}  // namespace reachlab::predict
