#include "devices/preflight/velocity_delay.h"

#include <numbers>

#include "base/ticks.h"
#include "sim/haptics/velocity_estimator.h"

namespace reachlab::devices {

double velocityDelay(const experiment::VelocityEstimatorSpec& spec) {
  constexpr double kDifference = kTickSeconds / 2;
  const double ofCutoff = 1 / (2 * std::numbers::pi * spec.cutoff);
  if (spec.kind == "device" || spec.kind == "kalman") return 0;
  if (spec.kind == "difference") return kDifference;
  if (spec.kind == "low-pass") return kDifference + ofCutoff;
  if (spec.kind == "adaptive-window") return haptics::VelocityEstimator::kMaxWindowDuration * kTickSeconds / 2;
  return kDifference + std::numbers::sqrt2 * ofCutoff;
}

}  // namespace reachlab::devices
