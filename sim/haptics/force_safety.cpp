#include "sim/haptics/force_safety.h"

#include <algorithm>
#include <cmath>

#include "base/ticks.h"

namespace reachlab::haptics {
namespace {

constexpr double kCautiousFrom = 0.8;  // of the heat budget

}  // namespace

double ForceSafety::heat() const noexcept { return limits_.continuous > 0 ? heat_ / (limits_.continuous * limits_.continuous) : 0; }

Vec3 ForceSafety::bound(const Vec3& force) noexcept {
  double bound = limits_.instantaneous * rampTicks_ * kTickSeconds / kRampSeconds;
  if (limits_.continuous > 0 && limits_.continuous < limits_.instantaneous) {
    const double used = std::clamp((heat() - kCautiousFrom) / (1 - kCautiousFrom), 0.0, 1.0);
    const double peak = limits_.instantaneous * limits_.instantaneous, rest = limits_.continuous * limits_.continuous;
    bound = std::min(bound, std::sqrt(peak + used * (rest - peak)));
  }
  const double size = norm(force);
  return size > bound ? (bound / size) * force : force;
}

Vec3 ForceSafety::limit(const Vec3& force, bool engaged, bool held) noexcept {
  if (!isFinite(force)) latched_ = true;
  if (latched_ || !engaged || !held) {
    rampTicks_ = 0;
    last_ = {};
  } else {
    rampTicks_ = std::min(rampTicks_ + 1, kRampSeconds / kTickSeconds);
    const Vec3 bounded = bound(force);
    const Vec3 change = bounded - last_;
    const double step = norm(change);
    last_ = step > kSlewPerTick ? last_ + (kSlewPerTick / step) * change : bounded;
  }
  if (limits_.continuous > 0) heat_ += kTickSeconds / limits_.thermalSeconds * (dot(last_, last_) - heat_);
  return last_;
}

}  // namespace reachlab::haptics
