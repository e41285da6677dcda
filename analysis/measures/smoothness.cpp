#include "analysis/measures/smoothness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace reachlab::analysis {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// |sum x_n exp(-i w n)| by Goertzel's recurrence.
double amplitudeAt(std::span<const double> x, double w) {
  const double c = 2 * std::cos(w);
  double s1 = 0, s2 = 0;
  for (const double v : x) {
    const double s = v + c * s1 - s2;
    s2 = s1;
    s1 = s;
  }
  return std::sqrt(std::max(0.0, s1 * s1 + s2 * s2 - c * s1 * s2));
}

}  // namespace

double computeSparc(std::span<const double> speed, double rate) {
  constexpr double kPadding = 4, kCutoff = 10, kLeastAmplitude = 0.05;  // powers of two of zeros appended, [Hz], of the largest (all 2015)
  double sum = 0;
  for (const double v : speed) sum += v;
  if (speed.size() < 2 || !(sum > 0) || !std::isfinite(sum) || !(rate > 0)) return kNone;
  const double bins = std::pow(2.0, std::ceil(std::log2(static_cast<double>(speed.size()))) + kPadding);
  // A speed is nowhere negative, so its spectrum is largest at 0 Hz: only the bins up to the cut-off are needed, not all of an FFT.
  std::vector<double> frequency, amplitude;
  for (int k = 0; k <= bins / 2; ++k) {
    const double f = k * rate / bins;
    if (f > kCutoff) break;
    frequency.push_back(f);
    amplitude.push_back(k == 0 ? 1.0 : amplitudeAt(speed, 2 * std::numbers::pi * k / bins) / sum);
  }
  const auto above = [&](double a) { return a >= kLeastAmplitude; };
  const auto last = static_cast<std::size_t>(amplitude.rend() - std::find_if(amplitude.rbegin(), amplitude.rend(), above)) - 1;
  const double band = frequency[last];
  double length = 0;
  for (std::size_t i = 1; i <= last; ++i) length += std::hypot((frequency[i] - frequency[i - 1]) / band, amplitude[i] - amplitude[i - 1]);
  return -length;
}

double computeLogDimensionlessJerk(std::span<const double> speed, double rate) {
  if (speed.size() < 3 || !(rate > 0)) return kNone;
  const double peak = *std::max_element(speed.begin(), speed.end());
  const double duration = static_cast<double>(speed.size()) / rate;
  double integral = 0;
  for (std::size_t i = 0; i + 2 < speed.size(); ++i) {
    const double jerk = (speed[i + 2] - 2 * speed[i + 1] + speed[i]) * rate * rate;
    integral += jerk * jerk / rate;
  }
  const double dimensionless = duration * duration * duration / (peak * peak) * integral;
  return dimensionless > 0 && std::isfinite(dimensionless) ? -std::log(dimensionless) : kNone;
}

std::size_t countPeaks(std::span<const double> speed, double prominence) {
  const std::size_t n = speed.size();
  if (n < 3) return 0;
  const double needed = prominence * *std::max_element(speed.begin(), speed.end());
  std::size_t peaks = 0;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (!(speed[i] > speed[i - 1])) continue;
    std::size_t end = i;  // a plateau counts once
    while (end + 1 < n && speed[end + 1] == speed[i]) ++end;
    if (end + 1 >= n || speed[end + 1] > speed[i]) continue;
    double left = speed[i], right = speed[i];
    for (std::size_t k = i; k-- > 0 && speed[k] <= speed[i];) left = std::min(left, speed[k]);
    for (std::size_t k = end + 1; k < n && speed[k] <= speed[i]; ++k) right = std::min(right, speed[k]);
    if (speed[i] - std::max(left, right) >= needed && speed[i] > 0) ++peaks;
    i = end;
  }
  return peaks;
}

}  // namespace reachlab::analysis
