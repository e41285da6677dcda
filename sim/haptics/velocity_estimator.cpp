#include "sim/haptics/velocity_estimator.h"

#include <cmath>
#include <numbers>

#include "sim/trial/protocol.h"

namespace reachlab::haptics {

VelocityEstimator::VelocityEstimator(const experiment::VelocityEstimatorSpec& spec)
    : fromDevice_(spec.kind == "auto" || spec.kind == "device"), filtered_(spec.kind != "difference") {
  if (!filtered_) return;
  // Bilinear transform of 1/(s^2 + sqrt(2) s + 1) with s = (1 - z^-1)/(1 + z^-1)/w, w = tan(pi fc dt).
  const double w = std::tan(std::numbers::pi * spec.cutoff * trial::kTickSeconds);
  const double norm = 1 + std::numbers::sqrt2 * w + w * w;
  b0_ = w * w / norm;
  a1_ = 2 * (w * w - 1) / norm;
  a2_ = (1 - std::numbers::sqrt2 * w + w * w) / norm;
}

Vec3 VelocityEstimator::estimate(const DeviceSample& sample) noexcept {
  if (count_ == 0) {
    x1_ = x2_ = y1_ = y2_ = {};
    last_ = sample.position;
    count_ = 1;
  }
  const Vec3 difference = (sample.position - last_) / trial::kTickSeconds;
  last_ = sample.position;
  if (fromDevice_ && sample.hasVelocity) return sample.velocity;
  if (!filtered_) return difference;
  const Vec3 y = b0_ * (difference + 2 * x1_ + x2_) - a1_ * y1_ - a2_ * y2_;
  x2_ = x1_;
  x1_ = difference;
  y2_ = y1_;
  y1_ = y;
  return y;
}

}  // namespace reachlab::haptics
