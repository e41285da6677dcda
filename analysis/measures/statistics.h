#pragma once
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

/// The few statistics that the tables need, each by its textbook formula. Pure functions for any thread.
namespace reachlab::analysis {

inline double sumOf(std::span<const double> values) { return std::accumulate(values.begin(), values.end(), 0.0); }
inline double averageOf(std::span<const double> values) { return sumOf(values) / static_cast<double>(values.size()); }
/// Each value of `a` less that of `b` beside it.
std::vector<double> subtract(std::span<const double> a, std::span<const double> b);

/// Mean and sample standard deviation (n - 1) of the finite values. The mean of no values and the SD of fewer than two values are NaN.
struct MeanSd {
  double mean = 0, sd = 0;
  std::size_t count = 0;
};
MeanSd computeMeanSd(std::span<const double> values);

struct Bounds {
  double low = 0, high = 0;
  bool finite() const { return std::isfinite(low) && std::isfinite(high); }  // false: there is no interval
  Bounds percent() const { return {100 * low, 100 * high}; }                 // of a share
};

/// Clopper and Pearson's exact interval of a binomial share (1934): covers at least `level` whatever the share. [0, 1] for no trials.
Bounds computeBinomialInterval(std::size_t successes, std::size_t trials, double level = 0.95);

}  // namespace reachlab::analysis
