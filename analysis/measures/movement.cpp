#include "analysis/measures/movement.h"

#include <algorithm>
#include <cmath>

namespace reachlab::analysis {
namespace {

void findPeak(std::span<const double> speed, double rate, std::size_t first, std::size_t last, Movement& movement) {
  std::size_t at = first;
  for (std::size_t i = first; i <= last; ++i)
    if (speed[i] > speed[at]) at = i;
  movement.peak = speed[at];
  double shift = 0;
  if (at > first && at < last) {
    const double curvature = speed[at - 1] - 2 * speed[at] + speed[at + 1];
    if (curvature < 0) shift = 0.5 * (speed[at - 1] - speed[at + 1]) / curvature;
  }
  movement.peakTime = (static_cast<double>(at) + shift) / rate;
}

}  // namespace

std::string_view nameOf(OnsetRule rule) {
  return rule == OnsetRule::Percent ? "percent" : rule == OnsetRule::Absolute ? "absolute" : "task";
}

Movement findMovement(std::span<const double> speed, double rate, const OnsetOptions& options) {
  Movement movement;
  const std::size_t n = speed.size();
  if (n < 3) return movement;
  findPeak(speed, rate, 0, n - 1, movement);
  const double threshold = options.rule == OnsetRule::Absolute ? options.speed : options.percent / 100 * movement.peak;
  if (!(movement.peak > threshold)) return movement;

  const auto crossing = [&](std::size_t i) {  // between samples i and i + 1
    return (static_cast<double>(i) + (threshold - speed[i]) / (speed[i + 1] - speed[i])) / rate;
  };
  const double shortest = std::max(1.0, options.holdSeconds * rate);
  // Back from the peak, so that a hand that drifted or twitched before the movement does not begin it. A movement of several humps may
  // rest between them below the threshold: the search starts at the first hump, the first sample above half the peak.
  const double hump = std::max(threshold, movement.peak / 2);
  std::size_t before = 0;
  while (speed[before] < hump) ++before;
  while (before > 0 && speed[before - 1] >= threshold) --before;
  movement.found = true;
  movement.onset = before == 0 ? 0 : crossing(before - 1);
  for (std::size_t i = before; i < n;) {
    if (speed[i] < threshold) {
      ++i;
      continue;
    }
    std::size_t end = i;  // one past the stretch above the threshold
    while (end < n && speed[end] >= threshold) ++end;
    if (static_cast<double>(end - i) >= shortest || i == before)
      movement.offset = end == n ? static_cast<double>(n - 1) / rate : crossing(end - 1);
    i = end;
  }
  return movement;
}

Movement movementWithin(std::span<const double> speed, double rate, double onset, double offset) {
  Movement movement;
  if (speed.size() < 3 || !(offset > onset)) return movement;
  const double last = static_cast<double>(speed.size() - 1);
  const auto first = static_cast<std::size_t>(std::clamp(std::ceil(onset * rate - 1e-9), 0.0, last));
  const auto end = static_cast<std::size_t>(std::clamp(std::floor(offset * rate + 1e-9), 0.0, last));
  if (end <= first) return movement;
  findPeak(speed, rate, first, end, movement);
  movement.found = true;
  movement.onset = onset;
  movement.offset = offset;
  return movement;
}

double valueAt(std::span<const double> signal, double rate, double time) {
  if (signal.empty()) return 0;
  const double at = std::clamp(time * rate, 0.0, static_cast<double>(signal.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(at), signal.size() - 1);
  if (i + 1 >= signal.size()) return signal.back();
  const double part = at - static_cast<double>(i);
  return (1 - part) * signal[i] + part * signal[i + 1];
}

double smoothValueAt(std::span<const double> x, double rate, double time) {
  const double at = time * rate;
  if (!(at >= 1) || at >= static_cast<double>(x.size()) - 2) return valueAt(x, rate, time);
  const auto i = static_cast<std::size_t>(at);
  const double s = at - static_cast<double>(i);
  const double p0 = x[i - 1], p1 = x[i], p2 = x[i + 1], p3 = x[i + 2];
  return p1 + 0.5 * s * (p2 - p0 + s * (2 * p0 - 5 * p1 + 4 * p2 - p3 + s * (3 * (p1 - p2) + p3 - p0)));
}

std::vector<double> normaliseTime(std::span<const double> signal, double rate, double onset, double offset) {
  std::vector<double> out(kProfilePoints);
  for (std::size_t i = 0; i < kProfilePoints; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(kProfilePoints - 1);
    out[i] = smoothValueAt(signal, rate, onset + part * (offset - onset));
  }
  return out;
}

std::vector<double> scaleVelocity(std::span<const double> velocity, double rate, double onset, double offset, double duration) {
  std::vector<double> out = normaliseTime(velocity, rate, onset, offset);
  for (double& v : out) v *= (offset - onset) / duration;
  return out;
}

}  // namespace reachlab::analysis
