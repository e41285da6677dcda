#include "sim/haptics/force_safety.h"

#include <algorithm>

#include "sim/trial/protocol.h"

namespace reachlab::haptics {

Vec3 ForceSafety::limit(const Vec3& force, bool engaged, bool held) noexcept {
  if (!isFinite(force)) latched_ = true;
  if (latched_ || !engaged || !held) {
    rampTicks_ = 0;
    return last_ = {};
  }
  rampTicks_ = std::min(rampTicks_ + 1, kRampSeconds / trial::kTickSeconds);
  const double bound = limit_ * rampTicks_ * trial::kTickSeconds / kRampSeconds;
  Vec3 bounded = force;
  if (const double size = norm(force); size > bound) bounded = (bound / size) * force;
  const Vec3 change = bounded - last_;
  const double step = norm(change);
  last_ = step > kSlewPerTick ? last_ + (kSlewPerTick / step) * change : bounded;
  return last_;
}

}  // namespace reachlab::haptics
