#include "analysis/figure/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reachlab::figure {
namespace {

double niceStep(double span, int wanted) {
  const double raw = span / std::max(1, wanted);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power * (1 + 1e-12)) return factor * power;
  return 10 * power;
}

std::string superscript(int exponent) {
  static const char* const kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

AxisTicks linearTicks(const Axis& axis, double low, double high, double length) {
  AxisTicks out;
  constexpr double kOneValue = 1e-12;  // of a value: values nearer to each other differ by rounding
  // One value, or none at all: an axis around it.
  if (!(high - low > kOneValue * std::max(std::abs(low), std::abs(high)))) {
    const double half = low == 0 || !std::isfinite(low) ? 1 : 0.5 * std::abs(low);
    const double middle = std::isfinite(low) ? low : 0;
    low = middle - half;
    high = middle + half;
  }
  const int wanted = std::clamp(static_cast<int>(length / 22), 2, 9);  // somewhat less than a centimetre between ticks
  const double step = niceStep(axis.to.value_or(high) - axis.from.value_or(low), wanted);
  // A quarter of a tick is round enough; a hair's width of slack keeps 0.3/0.1 from becoming one step more.
  out.from = axis.from.value_or(std::floor(low / (step / 4) + 1e-9) * step / 4);
  out.to = axis.to.value_or(std::ceil(high / (step / 4) - 1e-9) * step / 4);
  for (const double at : niceTicks(out.from, out.to, wanted)) out.major.emplace_back(at, tickText(at, step));
  return out;
}

AxisTicks logTicks(const Axis& axis, double low, double high, double length) {
  AxisTicks out;
  if (!(low > 0) || !std::isfinite(low)) low = high > 0 && std::isfinite(high) ? high / 10 : 0.1;
  if (!(high >= low)) high = 10 * low;
  const bool decades = std::log10(high / low) > 0.9;
  const auto round = [&](double value, bool down) {
    const double power = std::pow(10.0, std::floor(std::log10(value) + (down ? 1e-9 : -1e-9)));
    if (decades) return down ? power : 10 * power;
    const double steps[] = {1, 2, 5, 10};
    if (down) {
      for (int i = 3; i >= 0; --i)
        if (steps[i] * power <= value * (1 + 1e-9)) return steps[i] * power;
    } else {
      for (const double step : steps)
        if (step * power >= value * (1 - 1e-9)) return step * power;
    }
    return value;
  };
  out.from = axis.from.value_or(round(low, true));
  out.to = axis.to.value_or(round(high, false));
  if (!(out.to > out.from)) out.to = 10 * out.from;
  const int first = static_cast<int>(std::ceil(std::log10(out.from) - 1e-9)),
            last = static_cast<int>(std::floor(std::log10(out.to) + 1e-9));
  const int room = std::max(2, static_cast<int>(length / 26));
  const int every = std::max(1, (last - first + room) / room);
  const bool fewDecades = last - first < 2;
  for (int e = first - 1; e <= last; ++e) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double at = digit * std::pow(10.0, e);
      if (at < out.from * (1 - 1e-9) || at > out.to * (1 + 1e-9)) continue;
      if (digit == 1 && (e - first) % every == 0)
        out.major.emplace_back(at, fewDecades && std::abs(e) <= 3 ? fmt::format("{:g}", at) : "10" + superscript(e));
      else if (fewDecades && (digit == 2 || digit == 5)) out.major.emplace_back(at, fmt::format("{:g}", at));
      else if (every == 1 || (digit == 1 && length > 4.0 * (last - first))) out.minor.push_back(at);
    }
  }
  return out;
}

}  // namespace

std::vector<double> niceTicks(double from, double to, int wanted) {
  std::vector<double> ticks;
  if (!(from < to) || !std::isfinite(from) || !std::isfinite(to)) return ticks;
  const double step = niceStep(to - from, wanted);
  const double slack = 1e-9 * (to - from) / step;
  const double first = std::ceil(from / step - slack), count = std::floor(to / step + slack) - first;
  // Where the ends differ in their last digits only, no number between them is nicer than another.
  if (!(std::abs(first) < 1e12)) return ticks;
  for (int i = 0; i <= static_cast<int>(count); ++i) ticks.push_back(first + i == 0 ? 0.0 : (first + i) * step);
  return ticks;
}

std::string tickText(double value, double step) {
  if (std::abs(value) >= 1e6 || (step > 0 && step < 1e-5)) {
    const int exponent = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
    const std::string text = fmt::format("{:g}·10{}", value / std::pow(10.0, exponent), superscript(exponent));
    return value == 0 ? "0" : text.front() == '-' ? "−" + text.substr(1) : text;
  }
  int digits = 0;
  for (double s = step; digits < 7 && step > 0 && std::abs(s - std::round(s)) > 1e-6 * s; s *= 10) ++digits;
  std::string text = fmt::format("{:.{}f}", value, digits);
  if (std::stod(text) == 0 && text.front() == '-') text.erase(0, 1);
  return text.front() == '-' ? "−" + text.substr(1) : text;
}

AxisTicks chooseTicks(const Axis& axis, double low, double high, double length) {
  AxisTicks out = axis.scale == Scale::Log ? logTicks(axis, low, high, length) : linearTicks(axis, low, high, length);
  if (!axis.ticks.empty()) {
    out.minor.clear();
    out.major.clear();
    for (const auto& tick : axis.ticks)
      if (tick.first >= out.from && tick.first <= out.to) out.major.push_back(tick);
  }
  return out;
}

}  // namespace reachlab::figure
