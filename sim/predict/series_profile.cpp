#include "sim/predict/series_profile.h"

#include <algorithm>

namespace reachlab {

PredictedHand SeriesProfile::evaluate(int output, double t) const {
  const double x = t / width;
  const int panel = std::clamp(static_cast<int>(x), 0, panels - 1);
  const double s = x - panel;
  const double* c = of(panel, output);
  double position = 0, slope = 0, curvature = 0;  // Horner with two derivatives
  for (int k = terms; k-- > 0;) {
    curvature = curvature * s + slope;
    slope = slope * s + position;
    position = position * s + c[k];
  }
  return {position, slope / width, 2 * curvature / (width * width)};
}

}  // namespace reachlab
