#include "sim/analyze/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace reachlab::analyze {

MeanSd computeMeanSd(std::span<const double> values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  MeanSd out{0, kNone, 0};
  for (const double v : values)
    if (std::isfinite(v)) out.mean += v, ++out.count;
  if (out.count == 0) return {kNone, kNone, 0};
  out.mean /= static_cast<double>(out.count);
  if (out.count < 2) return out;
  double squares = 0;
  for (const double v : values)
    if (std::isfinite(v)) squares += (v - out.mean) * (v - out.mean);
  out.sd = std::sqrt(squares / static_cast<double>(out.count - 1));
  return out;
}

double normalQuantile(double share) {
  // Newton on the distribution function; from 0 it converges for every share met here (0.5 … 0.9999) and by symmetry below.
  if (share < 0.5) return -normalQuantile(1 - share);
  double x = 0;
  for (int i = 0; i < 60; ++i) {
    const double cdf = 0.5 * std::erfc(-x / std::numbers::sqrt2);
    const double density = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
    const double step = (share - cdf) / density;
    x += std::min(step, 1.0);
    if (std::abs(step) < 1e-13) break;
  }
  return x;
}

Interval computeWilsonInterval(std::size_t successes, std::size_t trials, double level) {
  if (trials == 0) return {0, 1};
  const double n = static_cast<double>(trials), p = static_cast<double>(successes) / n;
  const double z = normalQuantile(0.5 + level / 2), z2 = z * z;
  const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = z / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  // At none and at all the formula gives exactly 0 and 1, which rounding must not move.
  return {successes == 0 ? 0 : std::max(0.0, centre - half), successes == trials ? 1 : std::min(1.0, centre + half)};
}

double quantileOfSorted(std::span<const double> sorted, double share) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  if (i + 1 >= sorted.size()) return sorted.back();
  return sorted[i] + (at - static_cast<double>(i)) * (sorted[i + 1] - sorted[i]);
}

Interval centralInterval(std::vector<double> values, double level) {
  std::sort(values.begin(), values.end());
  return {quantileOfSorted(values, (1 - level) / 2), quantileOfSorted(values, (1 + level) / 2)};
}

std::size_t drawIndex(std::mt19937_64& random, std::size_t n) {
  // The share of 2^64 that does not divide evenly is below 1e-13 for any number of trials; std::uniform_int_distribution would differ
  // between libraries.
  return static_cast<std::size_t>(random() % n);
}

}  // namespace reachlab::analyze
