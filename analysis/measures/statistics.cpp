#include "analysis/measures/statistics.h"

#include <boost/math/distributions/binomial.hpp>
#include <limits>

namespace reachlab::analysis {

std::vector<double> subtract(std::span<const double> a, std::span<const double> b) {
  std::vector<double> apart(a.begin(), a.end());
  for (std::size_t i = 0; i < apart.size(); ++i) apart[i] -= b[i];
  return apart;
}

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

Bounds computeBinomialInterval(std::size_t successes, std::size_t trials, double level) {
  if (trials == 0) return {0, 1};
  using Binomial = boost::math::binomial_distribution<double>;
  const double n = static_cast<double>(trials), s = static_cast<double>(successes), outside = (1 - level) / 2;
  return {successes == 0 ? 0 : Binomial::find_lower_bound_on_p(n, s, outside),
          successes == trials ? 1 : Binomial::find_upper_bound_on_p(n, s, outside)};
}

}  // namespace reachlab::analysis
