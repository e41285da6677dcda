#include "sim/predict/series_profile.h"

#include <algorithm>

#include "sim/predict/pack.h"

namespace reachlab::predict {

PredictedHand SeriesProfile::evaluate(int output, double t) const {
  const double x = t / width;
  const int panel = std::clamp(static_cast<int>(x), 0, panels - 1);
  const double s = x - panel - centre;
  const double* c = of(panel, output);
  double position = 0, slope = 0, curvature = 0;  // Horner with two derivatives
  for (int k = terms; k-- > 0;) {
    curvature = curvature * s + slope;
    slope = slope * s + position;
    position = position * s + c[k];
  }
  return {position, slope / width, 2 * curvature / (width * width)};
}

void SeriesProfile::sampleVelocity(int output, double end, std::span<double> velocity) const {
  const auto panelOf = [&](double x) { return std::clamp(static_cast<int>(x), 0, panels - 1); };
  const double step = end / width / static_cast<double>(velocity.size() - 1);
  for (size_t done = 0; done < velocity.size();) {  // as many of a panel as a pack holds, side by side
    const int panel = panelOf(step * static_cast<double>(done));
    Pack s{}, position{}, slope{};
    int count = 0;
    for (; count < kPack && done + count < velocity.size(); ++count) {
      const double x = step * static_cast<double>(done + count);
      if (panelOf(x) != panel) break;
      s[count] = x - panel - centre;
    }
    const double* c = of(panel, output);
    for (int k = terms; k-- > 0;) {
      slope = slope * s + position;
      position = position * s + c[k];
    }
    for (int i = 0; i < count; ++i) velocity[done + i] = slope[i] / width;
    done += static_cast<size_t>(count);
  }
}

}  // namespace reachlab::predict
