#include "sim/haptics/velocity_estimator.h"

#include "base/ticks.h"

namespace reachlab::haptics {

VelocityEstimator::VelocityEstimator(const experiment::VelocityEstimatorSpec& spec)
    : fromDevice_(spec.kind == "auto" || spec.kind == "device"), filtered_(spec.kind != "difference") {
  if (filtered_) filter_ = butterworthLowPass(spec.cutoff, kTickSeconds);
}

Vec3 VelocityEstimator::estimate(const DeviceSample& sample) noexcept {
  if (count_ == 0) {
    x1_ = x2_ = y1_ = y2_ = {};
    last_ = sample.position;
    count_ = 1;
  }
  const Vec3 difference = (sample.position - last_) / kTickSeconds;
  last_ = sample.position;
  if (fromDevice_ && sample.hasVelocity) return sample.velocity;
  if (!filtered_) return difference;
  const Vec3 y = filter_.b[0] * (difference + 2 * x1_ + x2_) - filter_.a[1] * y1_ - filter_.a[2] * y2_;  // b1 = 2 b0, b2 = b0
  x2_ = x1_;
  x1_ = difference;
  y2_ = y1_;
  y1_ = y;
  return y;
}

}  // namespace reachlab::haptics
