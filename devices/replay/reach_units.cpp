#include <fmt/format.h>

#include "base/error.h"
#include "base/fault.h"
#include "devices/replay/recorded_reach.h"

namespace reachlab::devices {
namespace {

constexpr double kLongestGap = 0.1;  // [s]

}  // namespace

double metresOf(const std::string& unit, const std::string& origin) {
  if (unit == "m") return 1;
  if (unit == "cm") return 1e-2;
  if (unit == "mm") return 1e-3;
  throw FaultError(Fault{.what = fmt::format("{}: the unit of length is {}; allowed: m, cm, mm", origin, unit.empty() ? "not told" : "'" + unit + "'")});
}

double secondsOfUnit(const std::string& unit, const std::string& origin) {
  if (unit == "s") return 1;
  if (unit == "ms") return 1e-3;
  throw FaultError(Fault{.what = fmt::format("{}: the unit of time is {}; allowed: s, ms", origin, unit.empty() ? "not told" : "'" + unit + "'")});
}

void SeenSamples::add(double time, const Vec3& position) {
  if (!reach_.time.empty() && !(time > reach_.time.back()))
    throw FaultError(Fault{.what = fmt::format("{}: time does not increase at {} s; allowed: increasing times", reach_.file, time)});
  if (missed_ && !reach_.time.empty() && time - reach_.time.back() > kLongestGap)
    throw FaultError(Fault{.what = fmt::format("{}: the point is not seen for {:.3f} s from {:.3f} s; allowed: gaps of up to {} s", reach_.file,
                                 time - reach_.time.back(), reach_.time.back(), kLongestGap)});
  missed_ = false;
  reach_.time.push_back(time);
  reach_.position.push_back(position);
}

RecordedReach SeenSamples::take() {
  if (reach_.time.empty()) throw FaultError(Fault{.what = reach_.file + ": the point is never seen; allowed: at least two samples"});
  return std::move(reach_);
}

}  // namespace reachlab::devices
