#include "devices/replay/reach_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/longest_gap.h"

namespace reachlab::devices {
namespace {

constexpr double kRounding = 1e-6;  // [s] of times that a file gives

std::vector<double> gapsOf(const std::vector<double>& time) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < time.size(); ++i) gaps.push_back(time[i] - time[i - 1]);
  return gaps;
}

double medianOf(std::vector<double> gaps) {
  if (gaps.empty()) return 0;
  const auto median = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
  std::nth_element(gaps.begin(), median, gaps.end());
  return *median;
}

}  // namespace

void refuse(const FilePlace& place, const std::string& what, const std::string& allowed, const std::string& key) {
  throw FaultError(Fault{key, what, allowed, place});
}

double metresOf(const std::string& unit, const FilePlace& place, const std::string& key) {
  if (unit == "m") return 1;
  if (unit == "cm") return 1e-2;
  if (unit == "mm") return 1e-3;
  refuse(place, fmt::format("the unit of length is {}", unit.empty() ? "not told" : "'" + unit + "'"), "m, cm, mm", key);
}

double secondsOfUnit(const std::string& unit, const FilePlace& place, const std::string& key) {
  if (unit == "s") return 1;
  if (unit == "ms") return 1e-3;
  refuse(place, fmt::format("the unit of time is {}", unit.empty() ? "not told" : "'" + unit + "'"), "s, ms", key);
}

void SeenSamples::add(double time, const Vec3& position) {
  if (!reach_.time.empty() && !(time > reach_.time.back()))
    refuse({reach_.file}, fmt::format("time does not increase at {} s", time), "increasing times");
  reach_.time.push_back(time);
  reach_.position.push_back(position);
}

RecordedReach SeenSamples::take() {
  if (reach_.time.empty()) refuse({reach_.file}, "the point is never seen", "at least two samples");
  const std::vector<double> gaps = gapsOf(reach_.time);
  const double most = longestGap(medianOf(gaps));
  for (std::size_t i = 0; i < gaps.size(); ++i)
    if (gaps[i] > most + kRounding)
      refuse({reach_.file}, fmt::format("the point is not seen for {:.3f} s from {:.3f} s", gaps[i], reach_.time[i]),
             fmt::format("gaps of up to {:g} s", most));
  return std::move(reach_);
}

}  // namespace reachlab::devices
