#include "analysis/measures/recording_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/fault.h"

namespace reachlab::analysis {

std::vector<double> gregoryWeights(std::size_t samples) {
  std::vector<double> w(samples, 1.0);
  if (samples == 0) return w;
  w.front() = w.back() = samples == 1 ? 1.0 : 0.5;
  constexpr std::size_t kOrder = 7;  // differences used
  if (samples < 2 * (kOrder + 1)) return w;
  // Gregory's coefficients, Abramowitz and Stegun 25.4.
  constexpr std::array<double, kOrder> c{1.0 / 12, 1.0 / 24, 19.0 / 720, 3.0 / 160, 863.0 / 60480, 275.0 / 24192, 33953.0 / 3628800};
  for (std::size_t k = 1; k <= kOrder; ++k) {
    double binomial = 1;  // of (k over j), with the sign of the forward difference: (-1)^(k-j)
    for (std::size_t j = 0; j <= k; ++j) {
      const double sign = (k - j) % 2 == 0 ? 1 : -1;
      // h sum - c_k (nabla^k f_n + (-1)^k Delta^k f_0)
      const double forward = (k % 2 == 0 ? 1 : -1) * sign * binomial;
      w[j] -= c[k - 1] * forward;
      w[samples - 1 - j] -= c[k - 1] * (j % 2 == 0 ? 1 : -1) * binomial;
      binomial = binomial * static_cast<double>(k - j) / static_cast<double>(j + 1);
    }
  }
  return w;
}

RecordingFilter::RecordingFilter(double cutoff, double rate) : cutoff_(cutoff), rate_(rate) {
  if (!(rate > 0) || !std::isfinite(rate) || !(cutoff >= 0) || !(cutoff < rate / 2))
    throw FaultError(
        Fault{"cutoff", fmt::format("is {} Hz at {} samples per second", cutoff, rate), "0 (none) or more, below half the rate"});
  if (cutoff == 0) return;
  reach_ = 15 / (std::numbers::sqrt2 * std::numbers::pi * cutoff);  // exp(-15) along the filter's poles
  step_ = 1 / (160 * cutoff);
  // The gain is even about 0 and flat at rate / 2, so the trapezoidal rule is exact but for what the kernel is at multiples of
  // parts / rate, which is nothing there.
  const int parts = static_cast<int>(std::ceil(4 * reach_ * rate)) + 64;
  const double df = rate / 2 / parts;
  std::vector<double> gains(static_cast<std::size_t>(parts));
  for (int i = 0; i < parts; ++i) gains[static_cast<std::size_t>(i)] = (i == 0 ? 1.0 : 2.0) * gain(i * df);
  const auto count = static_cast<std::size_t>(std::ceil(reach_ / step_)) + 8;
  table_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    // cos(n a) by the stable recurrence of its half angle.
    const double a = 2 * std::numbers::pi * df * static_cast<double>(k) * step_;
    const double alpha = 2 * std::sin(a / 2) * std::sin(a / 2), beta = std::sin(a);
    double c = 1, s = 0, sum = 0;
    for (const double g : gains) {
      sum += g * c;
      const double next = c - (alpha * c + beta * s);
      s -= alpha * s - beta * c;
      c = next;
    }
    table_[k] = sum * df;
  }
}

double RecordingFilter::gain(double frequency) const {
  if (frequency >= rate_ / 2) return 0;
  const double ratio = std::tan(std::numbers::pi * frequency / rate_) / std::tan(std::numbers::pi * cutoff_ / rate_);
  return 1 / (1 + ratio * ratio * ratio * ratio);
}

double RecordingFilter::kernel(double seconds) const {
  const double x = std::abs(seconds) / step_;
  const auto i = static_cast<std::size_t>(x);
  if (i + 3 >= table_.size()) return 0;
  const double d = x - static_cast<double>(i);
  const auto at = [&](std::ptrdiff_t k) { return table_[static_cast<std::size_t>(std::abs(static_cast<std::ptrdiff_t>(i) + k))]; };
  // Six points, degree five.
  const double a = d + 2, b = d + 1, c = d, e = d - 1, f = d - 2, g = d - 3;
  return at(-2) * (b * c * e * f * g) / -120 + at(-1) * (a * c * e * f * g) / 24 + at(0) * (a * b * e * f * g) / -12 +
         at(1) * (a * b * c * f * g) / 12 + at(2) * (a * b * c * e * g) / -24 + at(3) * (a * b * c * e * f) / 120;
}

std::vector<double> RecordingFilter::apply(std::span<const double> signal, double duration, std::size_t margin) const {
  const std::size_t n = signal.size();
  std::vector<double> out(n + 2 * margin, 0.0);
  if (n < 2) return out;
  if (cutoff_ == 0) {
    std::copy(signal.begin(), signal.end(), out.begin() + static_cast<std::ptrdiff_t>(margin));
    return out;
  }
  const double step = duration / static_cast<double>(n - 1);
  std::vector<double> weighted = gregoryWeights(n);
  for (std::size_t i = 0; i < n; ++i) weighted[i] *= signal[i] * step;
  const auto taps = static_cast<std::size_t>(std::ceil(reach_ / step));
  std::vector<double> response(2 * taps + 1);
  for (std::size_t k = 0; k <= taps; ++k) response[taps - k] = response[taps + k] = kernel(static_cast<double>(k) * step);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = weighted[i];
    const std::size_t centre = i + margin;
    const std::size_t first = centre > taps ? centre - taps : 0, last = std::min(centre + taps, out.size() - 1);
    const double* r = response.data() + (taps + first - centre);
    double* o = out.data() + first;
    for (std::size_t j = 0; j <= last - first; ++j) o[j] += x * r[j];
  }
  return out;
}

}  // namespace reachlab::analysis
