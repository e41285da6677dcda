#include "devices/replay/reach_checks.h"

#include <fmt/format.h>

#include <cmath>

namespace reachlab::devices {
namespace {

constexpr double kLongestGap = 0.1;  // [s]

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
  const double last = reach_.time.empty() ? -INFINITY : reach_.time.back(), gap = time - last;
  if (!(gap > 0)) refuse({reach_.file}, fmt::format("time does not increase at {} s", time), "increasing times");
  if (missed_ && !reach_.time.empty() && gap > kLongestGap)
    refuse({reach_.file}, fmt::format("the point is not seen for {:.3f} s from {:.3f} s", gap, last),
           fmt::format("gaps of up to {} s", kLongestGap));
  missed_ = false;
  reach_.time.push_back(time);
  reach_.position.push_back(position);
}

RecordedReach SeenSamples::take() {
  if (reach_.time.empty()) refuse({reach_.file}, "the point is never seen", "at least two samples");
  return std::move(reach_);
}

}  // namespace reachlab::devices
