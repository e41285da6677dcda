#pragma once
#include <string>
#include <utility>
#include <vector>

#include "analysis/figure/figure.h"

namespace reachlab::figure {

/// The beginning and the end of an axis, and the labels along it.
struct AxisTicks {
  double from = 0, to = 1;
  std::vector<std::pair<double, std::string>> major;
  std::vector<double> minor;
};

/// `low` and `high` are the data's extent (not finite or reversed when there are no data), `length` the axis' length in points.
AxisTicks chooseTicks(const Axis& axis, double low, double high, double length);

}  // namespace reachlab::figure
