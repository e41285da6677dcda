#pragma once
#include <cstdint>
#include <random>
#include <span>
#include <vector>

/// The few statistics that the tables need, each by its textbook formula. Pure functions; any thread.
namespace reachlab::analyze {

/// Mean and sample standard deviation (n - 1) of the finite values; NaN where there are none (SD: fewer than two).
struct MeanSd {
  double mean = 0, sd = 0;
  std::size_t count = 0;
};
MeanSd computeMeanSd(std::span<const double> values);

struct Interval {
  double low = 0, high = 0;
};

/// Wilson's interval of a binomial share (Wilson 1927): honest for few trials and at 0 and 100 %. `level` of confidence; [0, 1] for no
/// trials at all.
Interval computeWilsonInterval(std::size_t successes, std::size_t trials, double level = 0.95);

/// Quantile of sorted values, linear between them (Hyndman and Fan's type 7). NaN for none.
double quantileOfSorted(std::span<const double> sorted, double share);
/// Central interval of the values at `level`; sorts a copy.
Interval centralInterval(std::vector<double> values, double level = 0.95);

/// 0 … n-1 evenly, the same numbers from the same seed with every standard library. n > 0.
std::size_t drawIndex(std::mt19937_64& random, std::size_t n);

/// Quantile of the standard normal distribution, share in (0, 1); absolute error below 1e-9.
double normalQuantile(double share);

}  // namespace reachlab::analyze
