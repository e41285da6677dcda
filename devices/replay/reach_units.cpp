#include <fmt/format.h>

#include "base/error.h"
#include "base/fault.h"
#include "devices/replay/recorded_reach.h"

namespace reachlab::devices {
namespace {

constexpr double kLongestGap = 0.1;  // [s]

}  // namespace

double metresOf(const std::string& unit, const FilePlace& place, const std::string& key) {
  if (unit == "m") return 1;
  if (unit == "cm") return 1e-2;
  if (unit == "mm") return 1e-3;
  throw FaultError(Fault{key, fmt::format("the unit of length is {}", unit.empty() ? "not told" : "'" + unit + "'"), "m, cm, mm", place});
}

double secondsOfUnit(const std::string& unit, const FilePlace& place, const std::string& key) {
  if (unit == "s") return 1;
  if (unit == "ms") return 1e-3;
  throw FaultError(Fault{key, fmt::format("the unit of time is {}", unit.empty() ? "not told" : "'" + unit + "'"), "s, ms", place});
}

void SeenSamples::add(double time, const Vec3& position) {
  if (!reach_.time.empty() && !(time > reach_.time.back()))
    throw FaultError(Fault{{}, fmt::format("time does not increase at {} s", time), "increasing times", FilePlace{reach_.file}});
  if (missed_ && !reach_.time.empty() && time - reach_.time.back() > kLongestGap)
    throw FaultError(Fault{{},
                           fmt::format("the point is not seen for {:.3f} s from {:.3f} s", time - reach_.time.back(), reach_.time.back()),
                           fmt::format("gaps of up to {} s", kLongestGap),
                           FilePlace{reach_.file}});
  missed_ = false;
  reach_.time.push_back(time);
  reach_.position.push_back(position);
}

RecordedReach SeenSamples::take() {
  if (reach_.time.empty()) throw FaultError(Fault{{}, "the point is never seen", "at least two samples", FilePlace{reach_.file}});
  return std::move(reach_);
}

}  // namespace reachlab::devices
