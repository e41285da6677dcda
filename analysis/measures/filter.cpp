#include "analysis/measures/filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "base/math/butterworth.h"

namespace reachlab::analysis {
namespace {

/// Direct form II transposed, started in the steady state of a constant `x0`.
void runFrom(const Biquad& s, double x0, std::vector<double>& signal) {
  const double gain = (s.b[0] + s.b[1] + s.b[2]) / (1 + s.a[1] + s.a[2]);
  double z2 = (s.b[2] - s.a[2] * gain) * x0;
  double z1 = (s.b[1] - s.a[1] * gain) * x0 + z2;
  for (double& x : signal) {
    const double y = s.b[0] * x + z1;
    z1 = s.b[1] * x - s.a[1] * y + z2;
    z2 = s.b[2] * x - s.a[2] * y;
    x = y;
  }
}

std::vector<double> filterBothWays(const Biquad& section, std::span<const double> signal) {
  const std::size_t n = signal.size();
  if (n < 2) return {signal.begin(), signal.end()};
  const std::size_t pad = std::min<std::size_t>(9, n - 1);  // three times the section's length
  std::vector<double> x;
  x.reserve(n + 2 * pad);
  for (std::size_t i = pad; i > 0; --i) x.push_back(2 * signal.front() - signal[i]);
  x.insert(x.end(), signal.begin(), signal.end());
  for (std::size_t i = 1; i <= pad; ++i) x.push_back(2 * signal.back() - signal[n - 1 - i]);
  for (int pass = 0; pass < 2; ++pass) {
    runFrom(section, x.front(), x);
    std::reverse(x.begin(), x.end());
  }
  return {x.begin() + static_cast<std::ptrdiff_t>(pad), x.end() - static_cast<std::ptrdiff_t>(pad)};
}

}  // namespace

std::vector<double> lowPass(std::span<const double> signal, double rate, double cutoff) {
  if (cutoff == 0) return {signal.begin(), signal.end()};
  if (!(cutoff > 0) || !(cutoff < rate / 2) || !std::isfinite(rate))
    throw FaultError(
        Fault{"cutoff", fmt::format("is {} Hz at {} samples per second", cutoff, rate), "more than 0 and less than half the rate"});
  return filterBothWays(butterworthLowPass(cutoff, 1 / rate), signal);
}

std::vector<double> differentiate(std::span<const double> x, double rate) {
  const std::size_t n = x.size();
  std::vector<double> v(n, 0.0);
  if (n < 3) return v;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const bool wide = i >= 2 && i + 2 < n;
    v[i] = wide ? rate * (8 * (x[i + 1] - x[i - 1]) - (x[i + 2] - x[i - 2])) / 12 : rate * (x[i + 1] - x[i - 1]) / 2;
  }
  v[0] = rate * (4 * x[1] - 3 * x[0] - x[2]) / 2;
  v[n - 1] = rate * (3 * x[n - 1] - 4 * x[n - 2] + x[n - 3]) / 2;
  return v;
}

}  // namespace reachlab::analysis
