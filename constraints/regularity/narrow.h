#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "constraints/formula/interval_series.h"

namespace reachlab::constraints::narrow {

// A place is narrow if a step of kWay there could miss a part kUnseen of the slope.
inline constexpr double kWay = 1e-3;  // [m]
inline constexpr double kUnseen = 1e-7;
inline constexpr int kBoxes = 20000;  // of a search: tenths of a second

/// How far a step may lead along s so that the terms of r from s^kOrder on change r_s by less than kUnseen of `speed`, the usual |r_s|.
/// `last` bounds the coefficient of s^kOrder.
inline double reachOf(double last, double speed) noexcept {
  constexpr int kOrder = IntervalSeries::kOrder;
  if (!(last > 0)) return std::numeric_limits<double>::infinity();
  return std::pow(kUnseen * speed / (kOrder * last), 1.0 / (kOrder - 1));
}

/// The median of `all`, which is not empty and is reordered.
inline double median(std::vector<double>& all) {
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

}  // namespace reachlab::constraints::narrow
