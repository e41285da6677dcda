#include "analysis/conclusions/comparison.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

namespace reachlab::analysis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TTest testOf(double mean, double variance, double count) {
  TTest out;
  out.mean = mean;
  out.freedom = count - 1;
  if (!(out.freedom > 0) || !std::isfinite(mean)) return out;
  out.error = std::sqrt(variance / count);
  if (!(out.error > 0)) {  // the same number every time: as sure as it can be, unless it is 0
    out.t = mean == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), mean);
    out.p = mean == 0 ? 1 : 0;
    return out;
  }
  out.t = mean / out.error;
  out.p = 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(out.freedom), std::abs(out.t)));
  return out;
}

double varianceOf(std::span<const double> values, double mean) {
  double sum = 0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return sum / (static_cast<double>(values.size()) - 1);
}

// Of the same number every time that number, which a rounded sum would miss by a scatter of its own.
double meanOf(std::span<const double> values) {
  if (std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end()) return values.front();
  return averageOf(values);
}

}  // namespace

TTest computeTTest(std::span<const double> values) {
  if (values.empty()) return {};
  const double mean = meanOf(values);
  if (values.size() < 2) return {mean, 0, 0, 0, 1};
  return testOf(mean, varianceOf(values, mean), static_cast<double>(values.size()));
}

double computeSerialCorrelation(std::span<const double> values) {
  if (values.size() < 3) return 0;
  const double mean = meanOf(values);
  double zero = 0, one = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    zero += (values[i] - mean) * (values[i] - mean);
    if (i > 0) one += (values[i] - mean) * (values[i - 1] - mean);
  }
  return zero > 0 ? std::max(0.0, one / zero) : 0;
}

TTest computeSerialTTest(std::span<const double> values) {
  if (values.size() < 2) return computeTTest(values);
  const double mean = meanOf(values), rho = computeSerialCorrelation(values);
  const double effective = static_cast<double>(values.size()) * (1 - rho) / (1 + rho);
  return testOf(mean, varianceOf(values, mean), effective);
}

TTest combineTTests(std::span<const TTest> conditions) {
  if (conditions.size() == 1) return conditions.front();
  TTest out;
  double variance = 0, weighted = 0;
  bool judged = !conditions.empty();
  for (const TTest& c : conditions) {
    out.mean += c.mean;
    judged = judged && c.freedom > 0;
    variance += c.error * c.error;
    if (c.freedom > 0) weighted += c.error * c.error * c.error * c.error / c.freedom;
  }
  const double k = static_cast<double>(conditions.size());
  out.mean /= k;
  if (!judged) return out;
  out.freedom = weighted > 0 ? variance * variance / weighted : 1;
  out.error = std::sqrt(variance) / k;
  // testOf divides by the count itself.
  const double count = out.freedom + 1;
  return testOf(out.mean, out.error * out.error * count, count);
}

double computeTQuantile(double level, double freedom) { return boost::math::quantile(boost::math::students_t(freedom), 0.5 + level / 2); }

Bounds intervalOf(const TTest& test, double level) {
  if (!(test.error > 0) || !(test.freedom > 0)) return {-kInfinity, kInfinity};
  const double half = computeTQuantile(level, test.freedom) * test.error;
  return {test.mean - half, test.mean + half};
}

double computeBayesFactor(const TTest& test) {
  if (!(test.freedom > 0)) return 1;
  if (!(test.error > 0)) return test.mean == 0 ? 1 : kInfinity;
  const double n = test.freedom + 1, square = test.t * test.t / test.freedom, power = -(test.freedom + 1) / 2;
  // Over the variance g of the effect, in equal steps of ln g. The prior of g falls like exp(-1 / 2g) below 1 and like g^(-3/2) above.
  constexpr double kFirst = -6, kLast = 40, kStep = 1.0 / 64, kScaleSquared = 0.5;
  double sum = 0;
  for (double x = kFirst; x <= kLast; x += kStep) {
    const double g = std::exp(x), spread = 1 + n * g * kScaleSquared;
    sum += std::exp(-0.5 * std::log(spread) + power * (std::log1p(square / spread) - std::log1p(square)) - 1 / (2 * g) - x / 2);
  }
  return sum * kStep / std::sqrt(2 * std::numbers::pi);
}

Bounds computeMeanInterval(std::span<const double> values, double level) {
  const TTest test = computeTTest(values);
  if (values.size() < 2) return {-kInfinity, kInfinity};
  const double quantile = computeTQuantile(level, test.freedom);
  return {test.mean - quantile * test.error, test.mean + quantile * test.error};
}

PeopleMean computePeopleMean(std::span<const double> values, std::span<const double> variance, double level) {
  PeopleMean out{computeTTest(values), computeMeanInterval(values, level)};
  if (values.size() < 2) return out;
  const boost::math::normal normal;
  const double own = std::sqrt(sumOf(variance)) / static_cast<double>(values.size());
  const double half = boost::math::quantile(normal, 0.5 + level / 2) * own;
  out.interval.low = std::min(out.interval.low, out.test.mean - half);
  out.interval.high = std::max(out.interval.high, out.test.mean + half);
  if (own > 0) out.test.p = std::max(out.test.p, 2 * boost::math::cdf(boost::math::complement(normal, std::abs(out.test.mean) / own)));
  return out;
}

double computeSignFlipP(std::span<const double> values) {
  constexpr std::size_t kMost = 20;
  const std::size_t n = std::min(values.size(), kMost);
  if (n == 0 || values.size() > kMost) return values.empty() ? 1 : computeTTest(values).p;
  double observed = 0;
  for (const double v : values) observed += v;
  observed = std::abs(observed) * (1 - 1e-12);  // sums in another order are the same sum
  // The first sign may stay: sums come in pairs.
  const std::uint64_t all = std::uint64_t{1} << (n - 1);
  std::uint64_t asFar = 0;
  for (std::uint64_t bits = 0; bits < all; ++bits) {
    double sum = values[0];
    for (std::size_t i = 1; i < n; ++i) sum += (bits >> (i - 1)) & 1 ? -values[i] : values[i];
    if (std::abs(sum) >= observed) ++asFar;
  }
  return static_cast<double>(asFar) / static_cast<double>(all);
}

std::vector<double> adjustByHolm(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> out(p.size());
  double largest = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(p.size() - i) * p[order[i]]));
    out[order[i]] = largest;
  }
  return out;
}

}  // namespace reachlab::analysis
