#include "sim/haptics/force_safety.h"

#include <algorithm>
#include <cmath>

#include "base/ticks.h"
#include "sim/haptics/hand_guard.h"

namespace reachlab::haptics {
namespace {

constexpr double kCautiousFrom = 0.8;  // of the heat budget
constexpr double kRampTicks = ForceSafety::kRampSeconds / kTickSeconds;

}  // namespace

double ForceSafety::heat() const noexcept { return limits_.continuous > 0 ? heat_ / (limits_.continuous * limits_.continuous) : 0; }

Vec3 ForceSafety::bound(const Vec3& force) noexcept {
  double bound = limits_.instantaneous * rampTicks_ * kTickSeconds / kRampSeconds;
  std::uint8_t by = rampTicks_ < kRampTicks ? intervention::kRamp : intervention::kLimit;  // rounding leaves 12 N a bit below 12 N
  if (limits_.continuous > 0 && limits_.continuous < limits_.instantaneous) {
    const double used = std::clamp((heat() - kCautiousFrom) / (1 - kCautiousFrom), 0.0, 1.0);
    const double peak = limits_.instantaneous * limits_.instantaneous, rest = limits_.continuous * limits_.continuous;
    const double warm = std::sqrt(peak + used * (rest - peak));
    if (warm < bound) by = intervention::kHeat;
    bound = std::min(bound, warm);
  }
  const double size = norm(force);
  if (!(size > bound)) return force;
  interventions_ |= by;
  return (bound / size) * force;
}

Vec3 ForceSafety::limit(const Vec3& force, bool engaged, bool held) noexcept {
  if (!isFinite(force)) latched_ = true;
  interventions_ = latched_ ? intervention::kNotFinite : engaged && !held ? intervention::kHeldBack : std::uint8_t{0};
  if (latched_ || !engaged || !held) {
    rampTicks_ = 0;
    last_ = {};
  } else {
    rampTicks_ = std::min(rampTicks_ + 1, kRampTicks);
    const Vec3 bounded = bound(force);
    const Vec3 change = bounded - last_;
    const double step = norm(change);
    if (step > kSlewPerTick) interventions_ |= intervention::kSlew;
    last_ = step > kSlewPerTick ? last_ + (kSlewPerTick / step) * change : bounded;
  }
  if (limits_.continuous > 0) heat_ += kTickSeconds / limits_.thermalSeconds * (dot(last_, last_) - heat_);
  return last_;
}

}  // namespace reachlab::haptics
